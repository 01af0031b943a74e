// The constraint functions g(y, t) of the loop joints, row by row as model::Loop defines them.
#pragma once

#include <vector>

#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// g of all loops in their order: zero where every loop is closed. Lengths in m, products of unit vectors without unit.
std::vector<Ex> derive_closure(Scene& scene);

}  // namespace jourdain::dynamics
