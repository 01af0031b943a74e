// Which numbers of a model depend on which: what tools need that look for loops through several models.
#pragma once

#include <string>
#include <vector>

#include "ir/module.hpp"
#include "programs/variables.hpp"

namespace jourdain::emit {

/// For each number of the variable a text with a '1' or '0' for t, each entry of y, of z and of u: '1' where the
/// program that computes the number reads it. Empty
/// where no emitted function computes the variable.
std::vector<std::string> what_depends(const programs::Variable& variable, const programs::SceneFacts& scene,
                                      const ir::Module& module);

}  // namespace jourdain::emit
