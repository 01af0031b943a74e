// States of mechanisms with closed loops in which all constraints hold: least-norm Newton steps on the
// reference's rows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/mechanism.hpp"
#include "reference/descriptor.hpp"
#include "reference/minimal.hpp"

namespace jourdain::tests {

/// y and z of the open tree, dependent coordinates included.
using LoopState = reference::State<long double>;

/// What loops leave of the tree's freedom at one state. Rows are scaled to unit length in z.
struct LoopFreedom {
  Eigen::Index rows = 0, rank = 0;          ///< of G in z; below `rows` where constraints are redundant
  long double weakest = 1;                  ///< smallest of the `rank` singular values over the largest
  reference::MatrixX<long double> motions;  ///< orthonormal columns: z with G z = 0; nz × (nz − rank)
};

LoopFreedom loop_freedom(const reference::LoopConstraints<long double>& constraints);

/// `y` displaced by `change`, one small displacement or rotation per velocity as model::Tangent has them.
reference::VectorX<long double> displaced(const model::Mechanism& mechanism,
                                          const reference::VectorX<long double>& y,
                                          const reference::VectorX<long double>& change);

/// What Newton's method leaves of g and G z + g_t, m, rad or their rates: a model's numbers are rounded to
/// double, so that redundant rows contradict each other by some 1e-16.
inline constexpr long double kClosed = 2e-15L;

/// The state near `near` with g = 0, then z moved the least to G z + g_t = 0; none where that does not converge.
std::optional<LoopState> closed_state(const model::Mechanism& mechanism, LoopState near);

/// `count` states near the initial positions, seeded: the first has those positions at t = 0, the others a way of up to
/// 0.3 rad or m from them (t up to 0.3 s where something is rheonomic). Rates of order 1. None where one does
/// not close.
std::optional<std::vector<LoopState>> consistent_states(const model::Mechanism& mechanism, std::uint64_t seed,
                                                        std::size_t count);

}  // namespace jourdain::tests
