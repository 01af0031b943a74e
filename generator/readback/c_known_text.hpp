// Passages of C that are written as they stand: sums of numbers, which in exact arithmetic are numbers.
#pragma once

#include <deque>
#include <string>

#include "readback/expression_parser.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

struct CKnownText {
  std::string name;  ///< of the type or function, without its prefix
  std::string text;
  Tokens tokens;  ///< of `text`
};

/// A second copy, apart from the templates: what is written must be this, token by token. What it computes is compared
/// with the C++ in tests/embed.
class CKnownTexts {
 public:
  explicit CKnownTexts(const CText& c);

  const std::deque<CKnownText>& all() const;

 private:
  std::deque<CKnownText> texts_;
};

}  // namespace jourdain::readback
