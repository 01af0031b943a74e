// Seeded random mechanisms with everything that a tree may have: all joints, prescribed motion, forces and outputs.
#pragma once

#include <cstdint>

#include "model/mechanism.hpp"

namespace jourdain::tests {

/// A random_tree of up to eight bodies whose joints are changed to any type (in a third of the seeds one is a
/// free joint), some coordinates prescribed, with friction, geared actuators, frames, loads, springs,
/// bushings, forces on coordinates, inputs and outputs of every kind. No joint moves nothing, and cond(M) ≤
/// 1e8 at `random_state(…, seed)`: other draws are thrown away.
model::Mechanism random_scene(std::uint64_t seed);

/// Whether some coordinate is prescribed, and whether some joint is free.
bool has_motion(const model::Mechanism& mechanism);
bool has_free_joint(const model::Mechanism& mechanism);

}  // namespace jourdain::tests
