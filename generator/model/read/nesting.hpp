// Guards for the parsers below us, which recurse into nested values.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace jourdain::model {

inline constexpr int kMaximumNesting = 32;

/// Offset of the first bracket, brace or dot of a dotted key of a TOML text that goes deeper than
/// kMaximumNesting.
std::optional<std::size_t> deep_toml_nesting(std::string_view text);

/// The elements of an XML text as far as they can be told apart without parsing it.
struct XmlTags {
  std::vector<std::size_t> starts;  ///< offset of the '<' of each start tag, in document order
  std::optional<std::size_t>
      deep_nesting;  ///< offset of the first one deeper than kMaximumNesting; the scan ends there
};

XmlTags scan_xml_tags(std::string_view text);

}  // namespace jourdain::model
