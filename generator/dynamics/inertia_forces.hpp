// Generalized inertia forces of a tree by one outward and one inward recursion on composite bodies.
#pragma once

#include <string>
#include <vector>

#include "dynamics/composite.hpp"

namespace jourdain::dynamics {

/// Motion that the inertia forces belong to. `rate` and `acceleration` are signed along the links' +z axes.
struct JointMotion {
  std::vector<Ex> rate;
  std::vector<Ex> acceleration;
  Vector3 ground_acceleration;  ///< of the inertial frame's origin: −gravity makes gravity an inertia force
};

/// ω of each link and of its parent, in the working frame of the link.
struct AngularVelocities {
  std::vector<Vector3> parent, own;
};

AngularVelocities derive_angular_velocities(const kinematics::LinkTree& tree,
                                            const kinematics::WorkingFrames& frames,
                                            const std::vector<Ex>& rate, kinematics::Statements& statements);

/// Generalized forces Σ J_tᵀ m a + J_rᵀ (I ω̇ + ω × I ω), one per coordinate (N m or N).
///
/// The acceleration field of link i differs from its parent's by ΔU (x − o_i), ΔU = (2 [ω_p] + q̇ [z]) [z] q̇ + [z] q̈
/// with ω_p the parent's angular velocity, and so does that of every link outward. So a joint feels two things: the
/// parent's field acting on its composite body, of which only the component along the axis is computed, and the
/// differences that the joints outward of it make on their composite bodies, summed inward as wrenches. The composite
/// bodies are those of the mass matrix; no force of a single link is computed. Its own difference has no moment
/// about the axis but q̈ J_zz.
std::vector<Ex> derive_inertia_forces(const kinematics::LinkTree& tree,
                                      const kinematics::WorkingFrames& frames,
                                      const std::vector<CompositeBody>& composites,
                                      const AngularVelocities& omega, const JointMotion& motion,
                                      const std::string& name, kinematics::Statements& statements);

}  // namespace jourdain::dynamics
