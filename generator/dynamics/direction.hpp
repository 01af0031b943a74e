// Derivatives of the symbolic equations along a direction, by the rules of calculus on their statements in
// high precision.
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/high_precision.hpp"
#include "model/coordinates.hpp"

namespace jourdain::dynamics {

/// A direction: displacements as model::Tangent has them, velocities, inputs, time.
template <class Real>
struct DirectionOf {
  std::vector<Real> displacement, velocity, input;
  Real time = 0;
};
using Direction = DirectionOf<double>;
using ExactDirection = DirectionOf<ScaledReal>;

/// The statements where the state moves along `direction`; `leaf` gives the point. Without
/// `tangent.quaternions` displacements are changes of y.
SlopePrecision moved_along(const ExactDirection& direction, const kinematics::Statements& statements,
                           const model::Tangent& tangent, const LeafValue& leaf);

ExactDirection exact(const Direction& direction);

}  // namespace jourdain::dynamics
