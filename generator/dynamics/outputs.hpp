// The outputs that the model asks for.
#pragma once

#include <vector>

#include "dynamics/applied_forces.hpp"
#include "dynamics/equations.hpp"

namespace jourdain::dynamics {

/// For each output of the mechanism its members; `zdot` are the accelerations that they take.
std::vector<std::vector<OutputValues>> derive_outputs(const Scene& scene, const Equations& equations,
                                                      const std::vector<Ex>& zdot,
                                                      const AppliedForces& applied);

/// The numbers of all outputs in their order, matrices row by row.
std::vector<Ex> output_entries(const Equations& equations);

}  // namespace jourdain::dynamics
