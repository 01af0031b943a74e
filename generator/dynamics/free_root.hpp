// Free links. z holds v of the child's origin in the inertial frame, which is C, and ω in child axes, which are those
// of W; the recursions take both in W, at the origin of L, `Link::shift` from the child's. Here one becomes the other.
#pragma once

#include <vector>

#include "dynamics/accelerations.hpp"

namespace jourdain::dynamics {

inline bool is_free(const kinematics::Link& link) { return link.kind == kinematics::LinkKind::kFree; }

/// Of the origin of L, in W.
Vector3 free_velocity(const Scene& scene, std::size_t link);
/// By ż, which may be empty as in joint_accelerations.
FreeAcceleration free_acceleration(const Scene& scene, std::size_t link, const std::vector<Ex>& zdot,
                                   Gravity gravity, const std::string& name);
/// ω̇ × d + ω × (ω × d) with d the shift, in W: what the origin of L accelerates beyond the child's. Zero of others.
Vector3 shift_acceleration(const Scene& scene, std::size_t link, const Vector3& spin_acceleration,
                           const std::string& name);

/// Rows of a link (force and moment about the origin of L, in W) as rows of z: about the child's origin, the force in
/// C. Those of other links as they are.
Wrench to_external(const Scene& scene, std::size_t link, const Wrench& wrench, const std::string& name);
std::vector<Ex> to_external(const Scene& scene, std::size_t link, const std::vector<Ex>& row,
                            const std::string& name);
/// The same of the weight of all that a link carries, whose force needs no rotation.
Wrench external_weight(const Scene& scene, std::size_t link, const Wrench& weight);

/// M with the blocks of the free links' own velocities: m 1, R (ω × h) with h from the child's origin, and J about it.
std::vector<std::vector<Ex>> with_free_blocks(const Scene& scene, std::vector<std::vector<Ex>> M);

/// ż of what was solved in W at the origin of L, less gravity.
std::vector<Ex> with_external_accelerations(const Scene& scene, std::vector<Ex> zdot);

/// `tau` with m (v̇ − gravity) of everything that a free link carries, about the child's origin; ż are the leaves.
std::vector<Ex> with_falling_mass(const Scene& scene, std::vector<Ex> tau);

/// ½ m |v|² + v · R (ω × h) + ½ ω · J ω of all that a free link carries, with v the velocity of the origin of L in C,
/// where it needs no rotation if L is the child's frame.
Ex free_energy(const Scene& scene, std::size_t link);

}  // namespace jourdain::dynamics
