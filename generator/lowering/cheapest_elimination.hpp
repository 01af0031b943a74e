// What all Jacobians of programs share: where displacements enter, and the cheapest order of elimination.
#pragma once

#include <functional>
#include <vector>

#include "ir/jacobian.hpp"
#include "model/coordinates.hpp"

namespace jourdain::lowering {

/// How the position leaves depend on the displacements of model::Tangent; columns are velocities.
std::vector<ir::Seed> displacement_seeds(ir::Builder& builder, const model::Tangent& tangent);

/// Operations that remain after one round of the passes that are quick.
std::size_t remaining_operations(const ir::Program& program);

/// Operations that remain after all passes.
std::size_t emitted_operations(const ir::Program& program);

/// The one of several orders of elimination whose program has the fewest operations after the passes.
ir::Program cheapest(const std::function<ir::Program(ir::EliminationOrder)>& build);

}  // namespace jourdain::lowering
