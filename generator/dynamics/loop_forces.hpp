// What the loops' constraint forces do to the bodies, as forces that are applied like any other.
#pragma once

#include <vector>

#include "dynamics/applied_forces.hpp"
#include "dynamics/closure.hpp"

namespace jourdain::dynamics {

/// `applied` with −λ times the gradient of each row on the two bodies of its loop and on their carrier; λ are
/// the leaves, row by row. A residual adds nothing: what it joins is not known (model::check_loops refuses
/// such outputs).
AppliedForces with_loop_forces(const Scene& scene, AppliedForces applied,
                               const std::vector<LoopClosure>& closures);

}  // namespace jourdain::dynamics
