// Joints whose dimensions would drown those of what they move: a small robot far from the inertial origin, a watch on a
// tower. Their link frames sit elsewhere than those of all others.
#pragma once

#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::kinematics {

/// How often the size of what a joint moves may fit into the distance to it. A link frame at the foot of the
/// perpendicular from the parent's origin saves operations, but everything outward is then seen from up to
/// that far away: second moments lose digits with the square of the ratio. The dimensions of robots differ by less.
inline constexpr double kFarAway = 64;
/// The same for slides, which keep first moments only: they lose with the ratio itself.
inline constexpr double kFarSlide = 1024;

/// For each joint whether it is further than kFarAway from what it is placed in, measured by what it moves (all at the
/// parameters' default values).
std::vector<bool> far_joints(const model::Mechanism& mechanism);

}  // namespace jourdain::kinematics
