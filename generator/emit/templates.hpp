// The text shells of templates/, compiled into the generator.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace jourdain::emit {

/// Text of templates/`file`. Asserts that the file exists.
std::string_view template_text(std::string_view file);

/// `text` with every @HOLE@ replaced by its value. Asserts that each hole of the text has a value.
std::string fill(std::string_view text, const std::map<std::string, std::string>& holes);

/// Name and text of each passage of templates/`file`, in order; a line "== NAME" stands in front of each.
std::vector<std::pair<std::string, std::string>> passages(std::string_view file);

}  // namespace jourdain::emit
