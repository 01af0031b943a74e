// Passages that are written as they stand: arithmetic of more than one number, which in exact arithmetic is
// that of one.
#pragma once

#include <array>
#include <string_view>

#include "readback/tokens.hpp"

namespace jourdain::readback {

/// A struct template that stands for the type of its numbers, with its functions.
struct KnownText {
  std::string_view scope;  ///< namespace within the outer one, or empty
  std::string_view type;   ///< name of the struct
  Tokens tokens;
};

/// A second copy, apart from the templates: what is written must be this, token by token. What it computes in
/// double and float is tested in tests/steppers.
const std::array<KnownText, 2>& known_texts();

}  // namespace jourdain::readback
