// Accelerations: of the coordinates as the recursions take them, and of the links that follow from them.
#pragma once

#include <string>
#include <vector>

#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// Whether gravity counts as an acceleration of the ground.
enum class Gravity { kNone, kAsAcceleration };

/// `zdot` one per entry of z, as the model defines z. Empty: no coordinate accelerates, and the origin of L of
/// a free link falls with gravity or moves on steadily (that of the child would accelerate where the two differ).
JointAccelerations joint_accelerations(Scene& scene, const std::vector<Ex>& zdot, Gravity gravity,
                                       const std::string& name);

/// v̇ of a free link's child, less gravity where that counts, in inertial axes.
Vector3 falling(Scene& scene, std::size_t link, const std::vector<Ex>& zdot, Gravity gravity);

/// ω̇ × d + ω × (ω × d) with d the shift of a free link: what the origin of L accelerates beyond the child's origin.
Vector3 shift_acceleration(Scene& scene, std::size_t link, const Vector3& spin_acceleration);

/// Of each link: α, and a of its origin, in W. With Gravity::kAsAcceleration a is less gravity.
std::vector<Twist> link_accelerations(Scene& scene, const std::vector<Ex>& zdot, Gravity gravity,
                                      const std::string& name);

}  // namespace jourdain::dynamics
