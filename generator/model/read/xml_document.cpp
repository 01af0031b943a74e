#include "model/read/xml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "support/line_index.hpp"

namespace jourdain::model {

using support::SourceRange;

namespace {

/// "XML_ERROR_MISMATCHED_ELEMENT" of tinyxml2 in words.
std::string syntax_message(std::string name) {
  constexpr std::string_view kPrefix = "XML_ERROR_";
  if (name.starts_with(kPrefix)) name.erase(0, kPrefix.size());
  for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return fmt::format("XML syntax error{} {}", name.starts_with("parsing ") ? " while" : ":", name);
}

SourceRange first_of_line(std::string_view text, int line) {
  const std::string_view shown_line = support::LineIndex(text).line(line);
  const std::size_t blanks = std::min(shown_line.find_first_not_of(" \t"), shown_line.size());
  return {line, static_cast<int>(blanks) + 1, 1};
}

}  // namespace

std::optional<XmlTags> parse_xml(support::Diagnostics& diagnostics, tinyxml2::XMLDocument& document) {
  const std::string& text = diagnostics.text();
  XmlTags tags = scan_xml_tags(text);
  if (tags.deep_nesting) {
    diagnostics.error(support::LineIndex(text).range(*tags.deep_nesting, 1),
                      fmt::format("nested deeper than {} levels", kMaximumNesting));
    return {};
  }
  document.Parse(text.data(), text.size());
  if (!document.Error()) return tags;
  diagnostics.error(first_of_line(text, document.ErrorLineNum()), syntax_message(document.ErrorName()));
  return {};
}

}  // namespace jourdain::model
