// Joints that move no inertia: M is singular there at every state, and the equations of motion have no
// solution.
#pragma once

#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::reference {

/// A pivot this small against its row's term sum is rounding: evaluated in long double, where the unit is
/// 5e-20.
inline constexpr long double kMasslessPivot = 1e-13L;

/// Joints whose pivot in M = LᵀDL, factored from the leaves, is at most kMasslessPivot of the sum of absolute
/// terms of its diagonal entry, at each of a few fixed states and with the default parameters. Such a joint
/// moves nothing, or nothing that the joints after it do not move as well (two coaxial revolute joints
/// without mass between them). In the order of the coordinates; empty for a mechanism that is singular only
/// in some positions.
std::vector<model::JointIndex> massless_joints(const model::Mechanism& mechanism);

}  // namespace jourdain::reference
