// Lines and columns of XML elements and attributes: tinyxml2 knows lines only.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "support/diagnostics.hpp"
#include "support/line_index.hpp"

namespace jourdain::model {

class XmlPositions {
 public:
  /// `starts`: offsets of the start tags of `document`, which was parsed from `text` (see scan_xml_tags).
  /// Both must outlive this object.
  XmlPositions(std::string_view text, const std::vector<std::size_t>& starts,
               const tinyxml2::XMLDocument& document);

  /// '<' and the name of the element; its line alone where its start tag was not found in the text.
  support::SourceRange element(const tinyxml2::XMLElement& element) const;

  /// The value of an attribute without its quotes, or of the element where it has no such attribute.
  support::SourceRange value(const tinyxml2::XMLElement& element, std::string_view attribute) const;

  /// `length` bytes from `offset` in the value, or the whole value where it is written with entities.
  support::SourceRange part_of_value(const tinyxml2::XMLElement& element, const char* attribute,
                                     std::size_t offset, std::size_t length) const;

 private:
  std::optional<std::string_view> written_value(const tinyxml2::XMLElement& element,
                                                std::string_view name) const;
  support::SourceRange range(std::string_view part) const;

  std::string_view text_;
  support::LineIndex lines_;
  std::unordered_map<const tinyxml2::XMLElement*, std::size_t> starts_;
};

}  // namespace jourdain::model
