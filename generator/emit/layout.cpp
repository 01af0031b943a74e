#include "emit/layout.hpp"

#include <algorithm>
#include <cctype>

namespace jourdain::emit {

namespace {

constexpr std::size_t kLineLength = 110;

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

std::string wrapped_doc(const std::string& content, std::size_t indent) {
  const std::string margin(indent, ' ');
  return broken(margin + "/// " + content, margin + "/// ", indent + 8);
}

std::string wrapped_comment(const std::string& content) { return broken("// " + content, "//   ", 8); }

std::string prefixed(const std::string& prefix, const std::string& lines) {
  std::string text;
  for (std::size_t begin = 0; begin <= lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    text += prefix + lines.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return text;
}

bool mentions(const std::string& text, const std::string& name) {
  const auto part_of_name = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)); };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const bool begins = at == 0 || !(part_of_name(text[at - 1]) || text[at - 1] == '.');
    const bool ends = at + name.size() == text.size() || !part_of_name(text[at + name.size()]);
    if (begins && ends) return true;
  }
  return false;
}

}  // namespace jourdain::emit
