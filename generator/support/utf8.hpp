// Splitting text into Unicode characters, tolerant of anything.
#pragma once

#include <cstddef>
#include <string_view>

namespace jourdain::support {

/// One character of a text: its length in bytes and whether a person may be shown it.
struct Utf8Character {
  std::size_t bytes = 1;  ///< 1 for a byte that is not valid UTF-8
  bool valid = false;     ///< well-formed UTF-8 (no overlong forms, no surrogates)
  bool printable =
      false;  ///< valid, and neither a control character nor one that changes the direction of text
};

/// The character at `offset` < text.size().
Utf8Character utf8_at(std::string_view text, std::size_t offset);

}  // namespace jourdain::support
