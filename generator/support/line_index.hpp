// From byte offsets of a text to lines and columns, and back.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "support/diagnostics.hpp"

namespace jourdain::support {

/// The lines of a text, which must outlive the index. Lines end with '\n'; a '\r' before it does not belong
/// to them.
class LineIndex {
 public:
  explicit LineIndex(std::string_view text);

  /// Line and column (in Unicode characters) of the byte at `offset`; the `length` bytes from there are
  /// underlined as far as they stand on that line.
  SourceRange range(std::size_t offset, std::size_t length) const;
  /// Bytes of line `number` (from 1); empty outside the text.
  std::string_view line(int number) const;
  /// Byte offset of a position; the end of the line for a column behind it.
  std::size_t offset(int line, int column) const;

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;
  bool ascii_ = false;  ///< bytes are characters: columns cost nothing
};

}  // namespace jourdain::support
