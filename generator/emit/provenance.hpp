// What the emitted header says about where it comes from.
#pragma once

#include <string>

#include "emit/model_files.hpp"

namespace jourdain::emit {

/// The comment at the top: source, equations, loops, assumptions, what was left out, what was checked.
std::string provenance(const ModelText& model, bool has_rate);

/// What a State holds, and which of its positions depend on others.
std::string state_doc(const ModelText& model);

}  // namespace jourdain::emit
