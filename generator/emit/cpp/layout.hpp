// Line breaking and comments of emitted text.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace jourdain::emit::cpp {

inline constexpr std::size_t kLineLength = 110;

/// A statement, indented, broken at spaces outside its string literals so that its lines stay short; ends with a line
/// break.
std::string wrapped(const std::string& line, std::size_t indent);

/// `opening`, the items of a list with commas between them, `closing`; items that do not fit on a line go on below the
/// first.
std::string aligned(const std::string& opening, const std::vector<std::string>& items,
                    const std::string& closing);

/// A doc comment, broken into lines that begin with "///".
std::string wrapped_doc(const std::string& content, std::size_t indent);

/// A `// ` comment of one or more lines.
std::string wrapped_comment(const std::string& content);

/// Text for a `//` comment of the emitted code: printable ASCII on one line, no trailing backslash.
std::string comment_text(const std::string& text);

/// Every line of `lines` with `prefix` in front.
std::string prefixed(const std::string& prefix, const std::string& lines);

}  // namespace jourdain::emit::cpp
