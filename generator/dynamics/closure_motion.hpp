// How the constraints of the loops change, by differences of the symbolic equations in 60 digits.
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/high_precision.hpp"
#include "model/coordinates.hpp"

namespace jourdain::dynamics {

/// At one state: g, its Jacobian G by small displacements and g_t (row by row), ġ = G z + g_t and γ = g̈ − G ż. Errors are those
/// of rounding to double.
struct ClosureMotion {
  std::vector<double> g, g_t, rate, gamma;
  std::vector<std::vector<double>> G;
};

/// `closures` need hold no more than the closures of the mechanism.
ClosureMotion closure_motion(const Equations& closures, const model::Tangent& tangent,
                             std::size_t velocity_count, const LeafValue& leaf);

}  // namespace jourdain::dynamics
