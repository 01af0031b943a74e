// Solution of M x = b in operations that grow with the length of the branches or with the number of links, or
// a mixture.
#pragma once

#include <vector>

#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// For each link whether its joint is eliminated with the link's articulated inertia (Featherstone, Rigid Body Dynamics
/// Algorithms, 2008, chapter 7). With a link its parent must be so, too; a free link always is. The joints of the other
/// links are eliminated from M, factored from the leaves (section 6.5 there), onto the nearest articulated link
/// inward. None: composite bodies and M = Lᵀ D L alone. All: the articulated-body algorithm.
using ArticulatedLinks = std::vector<bool>;

/// M with the rotors' inertia, and `b` one per entry of z, both in internal coordinates (the velocity of a
/// free link along its W, at the origin of L). Binds the factorisation and the solution.
std::vector<Ex> solve_accelerations(const Scene& scene, const ArticulatedLinks& articulated,
                                    const std::vector<Ex>& b);

/// dz/dt where the scene moves_in_planes, through the accelerations of links; `u` by planar_forces.
std::vector<Ex> solve_planar_accelerations(const Scene& scene, const std::vector<Ex>& u);

/// M x = b by entries of z, where each link has one and none is free: M in lower triangle, its entries between
/// different branches not looked at.
std::vector<Ex> solve_given(const Scene& scene, std::vector<std::vector<Ex>> M, const std::vector<Ex>& b);

}  // namespace jourdain::dynamics
