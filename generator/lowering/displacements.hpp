// Where displacements enter programs.
#pragma once

#include <vector>

#include "ir/jacobian.hpp"
#include "model/coordinates.hpp"

namespace jourdain::lowering {

/// How the position leaves depend on the displacements of model::Tangent; columns are velocities.
std::vector<ir::Seed> displacement_seeds(ir::Builder& builder, const model::Tangent& tangent);

}  // namespace jourdain::lowering
