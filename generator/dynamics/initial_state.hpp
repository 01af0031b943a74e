// The state that a description starts from.
#pragma once

#include "dynamics/equations.hpp"
#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// Fills in initial_position and initial_velocity, entry by entry of y and z.
void derive_initial_state(const Scene& scene, Equations& equations);

}  // namespace jourdain::dynamics
