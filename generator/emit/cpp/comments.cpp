#include "emit/cpp/comments.hpp"

#include "emit/layout.hpp"

namespace jourdain::emit::cpp {

std::string wrapped_doc(const std::string& content, std::size_t indent) {
  const std::string margin(indent, ' ');
  return wrapped_words(margin + "/// " + content, margin + "/// ", indent + 8);
}

std::string wrapped_comment(const std::string& content) { return wrapped_words("// " + content, "//   ", 8); }

}  // namespace jourdain::emit::cpp
