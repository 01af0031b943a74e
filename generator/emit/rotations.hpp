// Functions of linearly implicit steps for quaternions: small rotations that displace them, and the rates of those.
#pragma once

#include <vector>

#include "emit/tree.hpp"

namespace jourdain::emit {

/// turn, turning_rate, half_rotation, rotate, rotate_back. The first calls normalise.
std::vector<Function> rotation_functions();

}  // namespace jourdain::emit
