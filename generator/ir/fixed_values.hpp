// Which values of a program are numbers, or made with the model.
#pragma once

#include <functional>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::ir {

/// Parameters and what follows from them alone.
bool is_made_with_the_model(LeafKind kind, std::size_t index = 0);

/// Values that depend on nothing but literals and leaves that are fixed.
std::vector<bool> fixed_values(
    const Program& program,
    const std::function<bool(LeafKind, std::size_t)>& is_fixed = is_made_with_the_model);

}  // namespace jourdain::ir
