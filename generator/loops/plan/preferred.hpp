// Which velocities are rather independent than others.
#pragma once

#include <cstddef>
#include <vector>

#include "loops/rows/configuration.hpp"
#include "model/mechanism.hpp"

namespace jourdain::loops {

/// By velocity of the tree: coordinates that are driven, that the description starts with a velocity, or that others
/// follow.
std::vector<bool> preferred_velocities(const model::Mechanism& mechanism,
                                       const std::vector<Matrix>& jacobians);

/// Velocities of coordinates that are left to follow another one.
std::vector<std::size_t> following_velocities(const model::Mechanism& mechanism);

/// Velocities of the coordinates that the description names as independent.
std::vector<std::size_t> named_independent(const model::Mechanism& mechanism);

/// Velocities of the coordinates with a range, in order.
std::vector<std::size_t> ranged_velocities(const model::Mechanism& mechanism);

}  // namespace jourdain::loops
