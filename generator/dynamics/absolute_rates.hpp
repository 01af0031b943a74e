// Accelerations of chains that move in planes, with rates of links instead of joints: M then holds no moment
// twice, so that its factorisation does not lose what short links have beside long ones, and takes fewer operations.
#pragma once

#include <vector>

#include "dynamics/applied_forces.hpp"

namespace jourdain::dynamics {

/// Whether all links slide without ever turning, or turn one beside the other, and at least two do that.
bool moves_in_planes(const Scene& scene);

/// Forces on the rates of links, at zero accelerations: u of M_abs x = u.
std::vector<Ex> planar_forces(const Scene& scene, const AppliedForces& applied);

/// M_abs in lower triangle: rotors act between a link and its parent.
void add_planar_rotors(const Scene& scene, std::vector<std::vector<Ex>>& M);

/// dz/dt of the joints from accelerations x of the links.
std::vector<Ex> joint_rates_of(const Scene& scene, const std::vector<Ex>& x);

}  // namespace jourdain::dynamics
