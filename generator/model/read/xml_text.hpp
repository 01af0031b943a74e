// What all readers of XML do before they look at elements.
#pragma once

#include <tinyxml2.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "support/diagnostics.hpp"

namespace jourdain::model {

/// A parsed XML text and where its start tags stand in it.
struct XmlText {
  tinyxml2::XMLDocument document;
  std::vector<std::size_t> starts;
};

/// Attributes that an element may have.
inline constexpr std::size_t kMaximumAttributes = 1000;

/// Parses the text of `diagnostics`. Null after an error: nested too deeply, an element too wide, no XML.
std::unique_ptr<XmlText> parse_xml(support::Diagnostics& diagnostics);

/// The name of the first element of a text, as far as it looks like one; "" where there is none.
std::string first_element(const std::string& text);

/// The one element <`name`> that `format`, such as "a URDF file", is; null after an error. Another element behind it is
/// an error too, which leaves it to be read.
const tinyxml2::XMLElement* root_element(const XmlText& xml, std::string_view name, std::string_view format,
                                         support::Diagnostics& diagnostics);

}  // namespace jourdain::model
