// Which coordinates are angles.
#pragma once

#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// For each entry of y whether it is an angle of a scalar coordinate, rad.
std::vector<bool> angular_positions(const Mechanism& mechanism);

}  // namespace jourdain::model
