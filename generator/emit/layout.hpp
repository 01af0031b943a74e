// Line breaking and comments of emitted text.
#pragma once

#include <string>

namespace jourdain::emit {

/// A statement, indented, broken at spaces so that its lines stay short; ends with a line break.
std::string wrapped(const std::string& line, std::size_t indent);

/// A doc comment, broken into lines that begin with "///".
std::string wrapped_doc(const std::string& content, std::size_t indent);

/// A `// ` comment of one or more lines.
std::string wrapped_comment(const std::string& content);

/// Every line of `lines` with `prefix` in front.
std::string prefixed(const std::string& prefix, const std::string& lines);

/// Does C++ text use the identifier `name`? (Members of that name do not count.)
bool mentions(const std::string& text, const std::string& name);

}  // namespace jourdain::emit
