#include "model/read/xml_positions.hpp"

#include <cstring>

namespace jourdain::model {

namespace {

constexpr auto npos = std::string_view::npos;
constexpr std::string_view kBlanks = " \t\r\n";

/// The element after `element` in document order.
const tinyxml2::XMLElement* next_element(const tinyxml2::XMLElement* element) {
  if (const auto* child = element->FirstChildElement()) return child;
  for (const tinyxml2::XMLNode* node = element; node; node = node->Parent())
    if (const auto* sibling = node->NextSiblingElement()) return sibling;
  return nullptr;
}

}  // namespace

XmlPositions::XmlPositions(std::string_view text, const std::vector<std::size_t>& starts,
                           const tinyxml2::XMLDocument& document)
    : text_(text), lines_(text) {
  std::size_t i = 0;
  for (const auto* element = document.FirstChildElement(); element; element = next_element(element), ++i) {
    const bool same = i < starts.size() && text.substr(starts[i] + 1).starts_with(element->Name());
    if (!same) return;
    starts_[element] = starts[i];
  }
}

support::SourceRange XmlPositions::range(std::string_view part) const {
  return lines_.range(static_cast<std::size_t>(part.data() - text_.data()), part.size());
}

support::SourceRange XmlPositions::element(const tinyxml2::XMLElement& element) const {
  const auto start = starts_.find(&element);
  if (start == starts_.end()) return {element.GetLineNum(), 1, 1};
  return lines_.range(start->second, 1 + std::strlen(element.Name()));
}

std::optional<std::string_view> XmlPositions::written_value(const tinyxml2::XMLElement& element,
                                                            std::string_view name) const {
  const auto start = starts_.find(&element);
  if (start == starts_.end()) return {};
  std::string_view rest = text_.substr(start->second + 1 + std::strlen(element.Name()));
  for (;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    const std::size_t end = rest.find_first_of(" \t\r\n=>/");
    const std::size_t quote = rest.find_first_of("\"'>");
    if (end == npos || quote == npos || rest[quote] == '>') return {};
    const std::size_t close = rest.find(rest[quote], quote + 1);
    if (close == npos) return {};
    if (rest.substr(0, end) == name) return rest.substr(quote + 1, close - quote - 1);
    rest.remove_prefix(close + 1);
  }
}

support::SourceRange XmlPositions::value(const tinyxml2::XMLElement& where,
                                         std::string_view attribute) const {
  const auto value = written_value(where, attribute);
  return value ? range(*value) : element(where);
}

support::SourceRange XmlPositions::part_of_value(const tinyxml2::XMLElement& where, const char* attribute,
                                                 std::size_t offset, std::size_t length) const {
  const auto written = written_value(where, attribute);
  const char* const read = where.Attribute(attribute);
  const bool as_written = written && read && *written == read && offset <= written->size();
  return as_written ? range(written->substr(offset, length)) : value(where, attribute);
}

}  // namespace jourdain::model
