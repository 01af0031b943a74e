// Limbs of one shape on one body: legs of a quadruped, arms of a humanoid.
#pragma once

#include <vector>

#include "model/mechanism.hpp"
#include "passes/like_values.hpp"

namespace jourdain::programs {

/// Of each body, and of the world, the limbs that begin at it with moving joints of the same types in the same order,
/// two or more; their lengths and masses may differ. A limb's leaves are positions, velocities, accelerations and
/// inputs of its joints. None of mechanisms with loops.
std::vector<passes::LikeLimbs> like_limbs(const model::Mechanism& mechanism);

}  // namespace jourdain::programs
