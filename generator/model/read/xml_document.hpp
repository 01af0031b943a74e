// Parsing an XML text: what all readers of XML do first.
#pragma once

#include <tinyxml2.h>

#include <optional>

#include "model/read/nesting.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Parses the text of `diagnostics` into `document`; its start tags. Nothing after a diagnostic.
std::optional<XmlTags> parse_xml(support::Diagnostics& diagnostics, tinyxml2::XMLDocument& document);

}  // namespace jourdain::model
