// How the constraints of the loops change, by the rules of calculus on the symbolic equations in high precision.
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/high_precision.hpp"
#include "model/coordinates.hpp"

namespace jourdain::dynamics {

/// At one state: g, its Jacobian G by small displacements (row by row) and g_t.
struct ClosureJacobian {
  std::vector<ScaledReal> g, g_t;
  std::vector<std::vector<ScaledReal>> G;
};

/// Numbers of points that are looked for, where they are given: two for each dynamics::Search. Otherwise none.
using HeldPoints = std::vector<ScaledReal>;

/// `closures` need hold no more than the closures of the mechanism.
ClosureJacobian closure_jacobian(const Equations& closures, const model::Tangent& tangent,
                                 std::size_t velocity_count, const LeafValue& leaf,
                                 const HeldPoints& points = {});

/// g, ġ = G z + g_t and γ = g̈ − G ż at one state. Points that are looked for are held for ġ, and move in γ as
/// d(G z + g_t)/dt has it.
struct ClosureMotion {
  std::vector<ScaledReal> g, rate, gamma;
};

/// `z` are all velocities of the tree.
ClosureMotion closure_motion(const Equations& closures, const model::Tangent& tangent,
                             const std::vector<ScaledReal>& z, const LeafValue& leaf,
                             const HeldPoints& points = {});

/// g alone.
std::vector<ScaledReal> closure_values(const Equations& closures, const LeafValue& leaf,
                                       const HeldPoints& points = {});

/// What is found at `leaf`.
HeldPoints found_points(const Equations& closures, const LeafValue& leaf);

/// Where the points found at `leaf` are at `moved`, to first order, as their misfits stay what they are.
HeldPoints moved_points(const Equations& closures, const LeafValue& leaf, const LeafValue& moved);

/// Sum of Search::missed, m², and of 1 for each determinant and trace that is negative.
ScaledReal closure_misses(const Equations& closures, const LeafValue& leaf);

}  // namespace jourdain::dynamics
