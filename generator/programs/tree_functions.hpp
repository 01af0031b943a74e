// The equations of a tree as one program per emitted function, before any pass.
#pragma once

#include <string>

#include "dynamics/equations.hpp"
#include "ir/program.hpp"

namespace jourdain::programs {

/// The program of an emitted function that holds no derivatives, or of the residual M ż − k̄ + q̄.
ir::Program lower_function(const dynamics::Equations& equations, const std::string& function);

}  // namespace jourdain::programs
