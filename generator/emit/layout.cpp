#include "emit/layout.hpp"

#include <algorithm>

namespace jourdain::emit {

namespace {

enum class Strings { kBroken, kWhole };

/// The last space up to column kLineLength, with `kWhole` outside string literals.
std::size_t last_space(const std::string& line, Strings strings) {
  if (strings == Strings::kBroken) return line.rfind(' ', kLineLength);
  std::size_t space = std::string::npos;
  bool in_string = false;
  for (std::size_t k = 0; k <= kLineLength && k < line.size(); ++k) {
    if (in_string && line[k] == '\\')
      ++k;
    else if (line[k] == '"')
      in_string = !in_string;
    else if (line[k] == ' ' && !in_string)
      space = k;
  }
  return space;
}

/// `line` broken at spaces beyond column `earliest`; further lines start with `next`.
std::string broken(const std::string& line, const std::string& next, std::size_t earliest, Strings strings) {
  std::string text, rest = line;
  while (rest.size() > kLineLength) {
    const std::size_t space = last_space(rest, strings);
    if (space == std::string::npos || space <= earliest) break;
    text += rest.substr(0, space) + "\n";
    rest = next + rest.substr(space + 1);
  }
  return text + rest + "\n";
}

}  // namespace

std::string wrapped(const std::string& line, std::size_t indent) {
  return broken(std::string(indent, ' ') + line, std::string(indent + 4, ' '), indent + 4, Strings::kWhole);
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

std::string wrapped_words(const std::string& line, const std::string& next, std::size_t earliest) {
  return broken(line, next, earliest, Strings::kBroken);
}

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

}  // namespace jourdain::emit
