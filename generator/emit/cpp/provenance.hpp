// What the emitted header says about where it comes from.
#pragma once

#include <string>

#include "emit/file_text.hpp"

namespace jourdain::emit::cpp {

/// The comment at the top: source, equations, loops, assumptions, what was left out, what was checked.
std::string provenance(const ModelText& model, bool has_rate);

/// What a State holds, and which of its positions depend on others.
std::string state_doc(const ModelText& model);

}  // namespace jourdain::emit::cpp
