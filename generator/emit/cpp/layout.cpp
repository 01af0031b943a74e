#include "emit/cpp/layout.hpp"

#include <algorithm>

namespace jourdain::emit::cpp {

namespace {

/// `line` broken at spaces beyond column `earliest`; further lines start with `next`.
std::string broken(const std::string& line, const std::string& next, std::size_t earliest) {
  std::string text, rest = line;
  while (rest.size() > kLineLength) {
    const std::size_t space = rest.rfind(' ', kLineLength);
    if (space == std::string::npos || space <= earliest) break;
    text += rest.substr(0, space) + "\n";
    rest = next + rest.substr(space + 1);
  }
  return text + rest + "\n";
}

}  // namespace

std::string wrapped(const std::string& line, std::size_t indent) {
  return broken(std::string(indent, ' ') + line, std::string(indent + 4, ' '), indent + 4);
}

std::string aligned(const std::string& opening, const std::vector<std::string>& items,
                    const std::string& closing) {
  std::string text, line = opening;
  for (std::size_t k = 0; k < items.size(); ++k) {
    const std::string next = items[k] + (k + 1 < items.size() ? ", " : closing);
    if (line.size() + next.size() > kLineLength && k > 0) {
      text += line.substr(0, line.size() - 1) + "\n";
      line = std::string(opening.size(), ' ');
    }
    line += next;
  }
  return text + line + "\n";
}

std::string wrapped_doc(const std::string& content, std::size_t indent) {
  const std::string margin(indent, ' ');
  return broken(margin + "/// " + content, margin + "/// ", indent + 8);
}

std::string wrapped_comment(const std::string& content) { return broken("// " + content, "//   ", 8); }

std::string comment_text(const std::string& text) {
  std::string safe;
  for (char c : text) safe += (c >= ' ' && c <= '~' && c != '\\') ? c : '?';
  return safe;
}

std::string prefixed(const std::string& prefix, const std::string& lines) {
  std::string text;
  for (std::size_t begin = 0; begin <= lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    text += prefix + lines.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return text;
}

}  // namespace jourdain::emit::cpp
