// Random mechanisms with everything at once: loops, constraints of velocities, laws, tables, states, memories, stops,
// contacts, tyres, friction, cables and teeth.
#pragma once

#include <cstdint>

#include "model/mechanism.hpp"

namespace jourdain::tests {

/// random_scene, random_loops or random_rolling of the seed, in turn, with library elements as a description writes
/// them, and then laws of all functions. Forces are finite at random states.
model::Mechanism random_mixture(std::uint64_t seed);

}  // namespace jourdain::tests
