// What the emitted header says about where it comes from.
#pragma once

#include <string>
#include <vector>

#include "emit/file_text.hpp"

namespace jourdain::emit {

/// Source, equations, loops, assumptions, what was left out, what was checked: lines of a comment, without the sign
/// that begins one; those that go on a line before are indented by two. Three columns are left for that sign.
std::vector<std::string> provenance(const ModelText& model, bool has_rate);

}  // namespace jourdain::emit
