// Random chains of every type of joint, with everything that acts on their coordinates.
#pragma once

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

#include "model/coordinates.hpp"
#include "model/mechanism.hpp"
#include "support/enumerators.hpp"

namespace jourdain::tests {

/// Every type of joint.
inline constexpr auto kJointTypes = support::entries_of<model::JointType>();

/// One body per joint, each the child of the one before it, the first joint on the world; kFree only there. Placements,
/// axes, masses, joint springs, dampers, friction and gravity are random; inertias about the centre of mass along the
/// body's axes. Each coordinate has an actuator with gear and rotor. With `prescribed`, about every third coordinate
/// follows a motion.
model::Mechanism random_chain(const std::vector<model::JointType>& types, std::uint64_t seed,
                              bool prescribed = true);

/// Chains of random types, four joints each; the second joint runs through all types as the seed grows, the first one
/// instead where that type is kFree.
model::Mechanism random_chain(std::uint64_t seed, bool prescribed = true);

/// A state in minimal coordinates with inputs.
struct ChainState {
  long double t = 0;
  Eigen::VectorX<long double> y, z, u;
};

/// Coordinates and rates of order 1, unit quaternions.
ChainState random_chain_state(const model::CoordinateLayout& layout, std::uint64_t seed);

/// ẏ = Z(y) z.
Eigen::VectorX<long double> position_rates(const model::Mechanism& mechanism,
                                           const model::CoordinateLayout& layout, const ChainState& state);

}  // namespace jourdain::tests
