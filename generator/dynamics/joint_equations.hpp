// Functions of joints' coordinates made from the equations of links: a link's rate is the sum of those of its joints.
#pragma once

#include <string>
#include <vector>

#include "dynamics/link_equations.hpp"

namespace jourdain::dynamics {

/// M by entries of z, without rotors.
std::vector<std::vector<Ex>> joint_mass_matrix(const Scene& scene, const LinkEquations& equations);

/// Forces along each entry of z from forces f on the links.
std::vector<Ex> joint_forces(const Scene& scene, const std::vector<Ex>& f, const std::string& name);

/// f of wrenches on the links.
std::vector<Ex> link_loads(const Scene& scene, const std::vector<Wrench>& on_link);

/// M ż − k̄ + q̄ with ż a leaf, without rotors.
std::vector<Ex> link_inverse_dynamics(const Scene& scene, const LinkEquations& equations,
                                      const AppliedForces& applied);

/// ½ Σ M_ij w_i w_j by rates w of links, and the rotors', J.
Ex link_kinetic_energy(const Scene& scene, const LinkEquations& equations);

/// dz/dt.
std::vector<Ex> solve_link_equations(const Scene& scene, LinkEquations equations,
                                     const AppliedForces& applied);

}  // namespace jourdain::dynamics
