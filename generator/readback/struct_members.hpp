// Members that structs of the text must have, in either language.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "readback/expected.hpp"
#include "readback/findings.hpp"
#include "readback/syntax.hpp"

namespace jourdain::readback {

/// "Real y[3]" and so on.
using Texts = std::vector<std::string>;

bool linearizes(const Expected& expected);

/// By struct; all but Model.
std::map<std::string, Texts> struct_members(const Expected& expected);

/// "class Real = double".
std::string template_text(const Unit& unit, const Struct& found);

/// What the inside of a string literal says. `question_marks`: they are escaped, as C has trigraphs.
std::string unquoted(std::string_view text, bool question_marks = false);

void check_struct(const Unit& unit, const Struct& found, const Texts& wanted, Findings& findings);

}  // namespace jourdain::readback
