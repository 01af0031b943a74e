// Line breaking of emitted text, in any language.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace jourdain::emit {

inline constexpr std::size_t kLineLength = 110;

/// A statement, indented, broken at spaces outside its string literals so that its lines stay short; ends with a line
/// break.
std::string wrapped(const std::string& line, std::size_t indent);

/// `opening`, the items of a list with commas between them, `closing`; items that do not fit on a line go on below the
/// first.
std::string aligned(const std::string& opening, const std::vector<std::string>& items,
                    const std::string& closing);

/// Words in lines: `line` broken at spaces beyond column `earliest`, further lines begin with `next`; ends with a line
/// break.
std::string wrapped_words(const std::string& line, const std::string& next, std::size_t earliest);

/// Text for a comment of one line of the emitted code: printable ASCII, no backslash.
std::string comment_text(const std::string& text);

/// Every line of `lines` with `prefix` in front.
std::string prefixed(const std::string& prefix, const std::string& lines);

}  // namespace jourdain::emit
