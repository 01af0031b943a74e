// Passages of C that are written as they stand: sums of numbers, which in exact arithmetic are numbers.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "readback/expression_parser.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

struct CKnownText {
  std::string name;  ///< of the type or function, without its prefix
  std::string text;
  Tokens tokens;  ///< of `text`
  std::string meaning_text = {};
  std::optional<Tokens> meaning = {};  ///< what is read in its place, of `meaning_text`
};

struct CPassage {
  const char* name;
  const char*
      text;  ///< @N@, @D@: prefixes; @R@: number type; @F@: suffix of numbers; @S@: what splits a factor
};

/// A second copy, apart from the templates: what is written must be this, token by token. What it computes is compared
/// with the C++ in tests/embed.
class CKnownTexts {
 public:
  explicit CKnownTexts(const CText& c);

  const std::deque<CKnownText>& all() const;

 private:
  CKnownText& add(const CPassage& passage, const CText& c);
  void add_own_sines(const CText& c);
  static std::string filled(const std::string& text, const CText& c);

  std::deque<CKnownText> texts_;
};

}  // namespace jourdain::readback
