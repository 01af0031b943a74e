#include "model/read/xml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "model/read/nesting.hpp"
#include "model/read/xml_positions.hpp"
#include "support/line_index.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// "XML_ERROR_MISMATCHED_ELEMENT" of tinyxml2 in words.
std::string syntax_message(std::string name) {
  constexpr std::string_view kPrefix = "XML_ERROR_";
  if (name.starts_with(kPrefix)) name.erase(0, kPrefix.size());
  for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return fmt::format("XML syntax error{} {}", name.starts_with("parsing ") ? " while" : ":", name);
}

support::SourceRange first_of_line(std::string_view text, int line) {
  const std::string_view shown_line = support::LineIndex(text).line(line);
  const std::size_t blanks = std::min(shown_line.find_first_not_of(" \t"), shown_line.size());
  return {line, static_cast<int>(blanks) + 1, 1};
}

/// Attributes of the start tag at `begin`, as far as they can be told without parsing it.
std::size_t attribute_count(std::string_view text, std::size_t begin) {
  std::size_t count = 0;
  for (std::size_t i = begin; i < text.size() && text[i] != '>'; ++i) {
    if (text[i] == '=') ++count;
    if (text[i] != '"' && text[i] != '\'') continue;
    i = std::min(text.find(text[i], i + 1), text.size());
  }
  return count;
}

}  // namespace

std::unique_ptr<XmlText> parse_xml(support::Diagnostics& diagnostics) {
  const std::string& text = diagnostics.text();
  XmlTags tags = scan_xml_tags(text);
  if (tags.deep_nesting) {
    diagnostics.error(support::LineIndex(text).range(*tags.deep_nesting, 1),
                      fmt::format("nested deeper than {} levels", kMaximumNesting));
    return nullptr;
  }
  // The parser compares each attribute with all before it.
  for (const std::size_t start : tags.starts)
    if (const std::size_t count = attribute_count(text, start); count > kMaximumAttributes) {
      diagnostics.error(support::LineIndex(text).range(start, 1),
                        fmt::format("an element has {} attributes, more than {}", count, kMaximumAttributes));
      return nullptr;
    }
  auto xml = std::make_unique<XmlText>();
  xml->starts = std::move(tags.starts);
  xml->document.Parse(text.data(), text.size());
  if (!xml->document.Error()) return xml;
  diagnostics.error(first_of_line(text, xml->document.ErrorLineNum()),
                    syntax_message(xml->document.ErrorName()));
  return nullptr;
}

std::string first_element(const std::string& text) {
  const XmlTags tags = scan_xml_tags(text);
  if (tags.starts.empty()) return "";
  const std::size_t begin = tags.starts.front() + 1;
  return text.substr(begin, std::min(text.find_first_of(" \t\r\n/>", begin), text.size()) - begin);
}

const tinyxml2::XMLElement* root_element(const XmlText& xml, std::string_view name, std::string_view format,
                                         support::Diagnostics& diagnostics) {
  const XmlPositions positions(diagnostics.text(), xml.starts, xml.document);
  const tinyxml2::XMLElement* root = xml.document.RootElement();
  if (!root || root->Name() != name) {
    diagnostics.error(root ? positions.element(*root) : support::SourceRange{},
                      fmt::format("{} has one element <{}>", format, name),
                      root ? fmt::format("found <{}>", shown(root->Name())) : "");
    return nullptr;
  }
  if (const tinyxml2::XMLElement* second = root->NextSiblingElement())
    diagnostics.error(positions.element(*second),
                      fmt::format("<{}> stands behind the end of <{}>", shown(second->Name()), name));
  return root;
}

}  // namespace jourdain::model
