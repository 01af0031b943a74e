// Seeded random mechanisms with closed loops: planar and spatial, one to three loops of every type of loop joint.
#pragma once

#include <cstdint>

#include "model/mechanism.hpp"

namespace jourdain::tests {

/// What the mechanism of a seed is made to exercise.
enum class LoopClass {
  kPlanar,  ///< seed % 8 == 0, 1: all moves in one plane, at times a tilted one; no redundant constraints
  kOverconstrained,  ///< 2: the same closed by spatial joints: rows that the plane makes redundant
  kParallelogram,    ///< 3: a platform on two to four equal parallel cranks: loops redundant among each other
  kSpatial           ///< 4 to 7: any joints, at times a spherical or a free one; rows may be redundant or not
};

LoopClass loop_class(std::uint64_t seed);

/// The least that the weakest independent constraint may weigh beside the strongest one (see LoopFreedom).
inline constexpr double kWeakestConstraint = 1e-3;

/// One to three loops ((seed / 8) % 3 of them beyond the first) on a tree of up to nine bodies, closed at the initial
/// positions at t = 0, where rates of zero are consistent, too. At times prescribed coordinates, rods whose
/// length changes, residuals that know time; gravity, joint springs, dampers, actuators, springs, a tunable
/// parameter. The rank of the loops' rows is the same at `consistent_states(…, seed, kLoopStates)`, at least
/// one degree of freedom is left, every coordinate that loops hold moves, no joint moves nothing and cond(M) ≤
/// 1e8: other draws are thrown away.
model::Mechanism random_loops(std::uint64_t seed);

/// States at which a draw is judged.
inline constexpr std::size_t kLoopStates = 4;

}  // namespace jourdain::tests
