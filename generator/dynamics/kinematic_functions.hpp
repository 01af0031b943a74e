// The functions of the kinematics and of momentum that the scene asks for.
#pragma once

#include <functional>
#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// What the Jacobian is called from which an operational inertia is made.
inline constexpr const char* kOperationalJacobian = "J_operational";

/// For each of the mechanism's functions its arrays, in the order of its quantities; of the operational inertia the
/// Jacobian. `gravity` derives the entries of q̄ that gravity makes. Biases are at ż = 0;
/// where there are loops at the leaves ż, which then stand for the accelerations that velocities alone make.
std::vector<std::vector<KinematicValues>> derive_kinematic_functions(
    const Scene& scene, const std::function<std::vector<Ex>()>& gravity);

}  // namespace jourdain::dynamics
