// Comments of emitted C++.
#pragma once

#include <cstddef>
#include <string>

namespace jourdain::emit::cpp {

/// A doc comment, broken into lines that begin with "///".
std::string wrapped_doc(const std::string& content, std::size_t indent);

/// A `// ` comment of one or more lines.
std::string wrapped_comment(const std::string& content);

}  // namespace jourdain::emit::cpp
