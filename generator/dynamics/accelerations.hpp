// Accelerations: of the coordinates as the recursions take them, and of the links that follow from them.
#pragma once

#include <string>
#include <vector>

#include "dynamics/inertia_forces.hpp"

namespace jourdain::dynamics {

/// Whether gravity counts as an acceleration of the ground.
enum class Gravity { kNone, kAsAcceleration };

/// `zdot` one per entry of z, as the model defines z. Empty: no coordinate accelerates, and the origin of L of
/// a free link falls with gravity or moves on steadily (that of the child would accelerate where the two differ).
JointAccelerations joint_accelerations(const Scene& scene, const std::vector<Ex>& zdot, Gravity gravity,
                                       const std::string& name);

/// U = [α] + [ω][ω], so that points of a body at x from its origin have the acceleration a + U x.
kinematics::Matrix3 acceleration_gradient(const Vector3& omega, const Vector3& alpha, const std::string& name,
                                          kinematics::Statements& statements);

/// Acceleration of a link's origin as a point of its parent: α × r + ω × (ω × r), or U r where U serves others.
enum class OriginField { kCrossProducts, kGradient };

/// Of each link: α, and a of its origin, in W.
std::vector<Twist> link_accelerations(const Scene& scene, const JointAccelerations& motion,
                                      const std::string& name, OriginField field);

/// The same by ż. With Gravity::kAsAcceleration a is less gravity.
std::vector<Twist> link_accelerations(const Scene& scene, const std::vector<Ex>& zdot, Gravity gravity,
                                      const std::string& name);

}  // namespace jourdain::dynamics
