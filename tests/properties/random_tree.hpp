// Seeded random mechanisms for property tests: what no one would write down by hand, but a user might.
#pragma once

#include <cstdint>

#include "model/mechanism.hpp"
#include "reference/minimal.hpp"

namespace jourdain::tests {

/// What the mechanism of a seed is made to exercise.
enum class TreeClass {
  kAligned,     ///< seed % 10 == 0: rotations are signed permutations, axes ±x, ±y, ±z
  kParallel,    ///< 1: some revolute joint is parallel to the revolute joint that it follows
  kMassless,    ///< 2: at least one body without mass and inertia, M regular nevertheless
  kMassRatios,  ///< 3: masses from 1e-3 to 1e3 kg, so up to 1e±6 between bodies
  kParameters,  ///< 4: masses, inertias, lengths, angles, gravity or springs depend on tunable parameters
  kGeneral,     ///< 5 to 9
};

TreeClass tree_class(std::uint64_t seed);

/// The largest condition number of M that `random_tree` lets pass, at its random state.
inline constexpr double kMaximumCondition = 1e12;

/// A mechanism of 1 to 12 bodies: revolute, prismatic and fixed joints on a random tree (at times several
/// trees on the world), declared in random order; physically valid inertias, springs, dampers and actuators
/// on some joints. At least one joint moves, no joint moves nothing, and cond(M) ≤ kMaximumCondition at
/// `random_state(…, seed)`: other draws are thrown away, so that the same seed gives the same mechanism
/// everywhere.
model::Mechanism random_tree(std::uint64_t seed);

/// Angles in ±π rad, displacements in ±1 m, rates in ±2 rad/s or m/s.
reference::State<double> random_state(const model::Mechanism& mechanism, std::uint64_t seed);

/// One value in ±5 N or N m per actuator.
reference::VectorX<double> random_inputs(const model::Mechanism& mechanism, std::uint64_t seed);

}  // namespace jourdain::tests
