// What holds of every reader's diagnostics.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

#include "support/diagnostics.hpp"
#include "support/utf8.hpp"

namespace jourdain::tests {

/// Ends the program where `holds` is false: the fuzzer keeps the input.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// A file was taken or has errors, never both nor neither; each error names a line that there is, or the file; the text
/// for a terminal can be shown there.
inline void check_said(const support::Diagnostics& diagnostics, bool taken) {
  require(taken != diagnostics.has_errors());
  for (const support::Diagnostic& diagnostic : diagnostics.all())
    require(diagnostic.where.line >= 0 && (diagnostic.where.line == 0 || diagnostic.where.column >= 1));
  const std::string text = diagnostics.format();
  for (std::size_t i = 0; i < text.size();) {
    const support::Utf8Character character = support::utf8_at(text, i);
    require(character.printable || text[i] == '\n');
    i += character.bytes;
  }
}

}  // namespace jourdain::tests
