// Random mechanisms some of whose constraints bind velocities alone.
#pragma once

#include <cstdint>

#include "model/mechanism.hpp"

namespace jourdain::tests {

/// random_scene, every third time random_loops and a body that flies, with one or two constraints more: wheels, balls
/// and ellipsoids that roll and blades on the world or on bodies that move, expressions of rates, positions and time.
/// Closed at the initial positions. What the constraints leave free is as many at
/// `consistent_states(..., seed, kLoopStates)`, and one degree of freedom or more; other draws are thrown away.
model::Mechanism random_rolling(std::uint64_t seed);

/// It, asked to have independent velocities, its coordinates within 0.45 rad or m of where they start, so that more can
/// be proven.
model::Mechanism asking_for_independent_velocities(model::Mechanism mechanism);

}  // namespace jourdain::tests
