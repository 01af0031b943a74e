#include "emit/templates.hpp"

#include <algorithm>

#include "emit/template_table.hpp"
#include "support/check.hpp"

namespace jourdain::emit {

std::string_view template_text(std::string_view file) {
  for (const auto& [name, text] : kTemplates)
    if (name == file) return text;
  JD_CHECK(false, "no template '{}'", file);
  return {};
}

std::vector<std::pair<std::string, std::string>> passages(std::string_view file) {
  const std::string text(template_text(file));
  std::vector<std::pair<std::string, std::string>> list;
  for (std::size_t at = text.find("== "); at < text.size();) {
    const std::size_t end = text.find('\n', at),
                      next = std::min(text.find("\n== ", end), text.size() - 1) + 1;
    list.emplace_back(text.substr(at + 3, end - at - 3), text.substr(end + 1, next - end - 1));
    at = next;
  }
  return list;
}

std::string fill(std::string_view text, const std::map<std::string, std::string>& holes) {
  std::string filled;
  std::size_t position = 0;
  for (std::size_t open; (open = text.find('@', position)) != std::string_view::npos;) {
    const std::size_t close = text.find('@', open + 1);
    JD_CHECK(close != std::string_view::npos, "unclosed hole at offset {}", open);
    const auto hole = holes.find(std::string(text.substr(open + 1, close - open - 1)));
    JD_CHECK(hole != holes.end(), "no value for hole '{}'", text.substr(open + 1, close - open - 1));
    filled += text.substr(position, open - position);
    filled += hole->second;
    position = close + 1;
  }
  filled += text.substr(position);
  return filled;
}

}  // namespace jourdain::emit
