// The constraint functions g(y, t) of the loop joints, row by row as model::Loop defines them.
#pragma once

#include <vector>

#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// Of one loop.
struct LoopClosure {
  std::vector<Ex>
      rows;  ///< g: zero where the loop is closed. Lengths in m, products of unit vectors without unit
  std::vector<Ex>
      senses;  ///< products of unit vectors that are 1 where it is closed, and −1 where it is closed the wrong way
};

/// By loop.
std::vector<LoopClosure> derive_closure(Scene& scene);

}  // namespace jourdain::dynamics
