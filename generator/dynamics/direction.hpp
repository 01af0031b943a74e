// Derivatives of the symbolic equations along a direction, by central differences in 60 digits.
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/high_precision.hpp"
#include "model/coordinates.hpp"

namespace jourdain::dynamics {

/// A direction: displacements as model::Tangent has them, velocities, inputs, time.
struct Direction {
  std::vector<double> displacement, velocity, input;
  double time = 0;
};

/// How the equations change along a direction per unit of it; M ż − k̄ + q̄ at constant ż. Errors are those of rounding
/// in 60 digits over a step of 1e-20, and the square of that step.
struct DirectionalDerivatives {
  std::vector<double> residual, q_bar, zdot, outputs;
};

/// `leaf` gives the point. Without `tangent.quaternions` displacements are changes of y.
DirectionalDerivatives derivatives_along(const Direction& direction, const Equations& equations,
                                         const model::Tangent& tangent, const LeafValue& leaf);

}  // namespace jourdain::dynamics
