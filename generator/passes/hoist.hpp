// Values that depend on parameters only leave the functions: they are computed once, with the model.
#pragma once

#include "ir/module.hpp"

namespace jourdain::passes {

/// Exact. Moves every operation on literals and parameters alone into the module's constants and every parameter that
/// a function reads into a constant, so that functions read constants, state and inputs only. An output that is a
/// literal stays where it is. Idempotent: constants that the module has already keep their places.
ir::Module hoist(const ir::Module& module);

}  // namespace jourdain::passes
