// Joints that move no inertia, at every state or at one: M is singular there, and the equations of motion have no
// solution.
#pragma once

#include <vector>

#include "model/mechanism.hpp"
#include "reference/minimal.hpp"

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

/// Joints whose pivot is negative, by more than rounding, at one of the same states: bodies with indefinite
/// inertias can have a negative kinetic energy.
std::vector<model::JointIndex> negative_joints(const model::Mechanism& mechanism);

/// A pivot this small against its row's term sum elsewhere is that of an angle which double rounds to the singular one:
/// the square of 6e-17 for π/2.
inline constexpr long double kSingularPivot = 1e-30L;

/// Joints whose pivot vanishes at `state`, as in a gimbal's lock: rounding of its own terms, or kSingularPivot
/// of those at another state.
std::vector<model::JointIndex> singular_joints(const model::Mechanism& mechanism,
                                               const State<long double>& state);

}  // namespace jourdain::reference
