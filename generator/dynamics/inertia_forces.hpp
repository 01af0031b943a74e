// Generalized inertia forces of a tree by one outward and one inward recursion on composite bodies.
#pragma once

#include <string>
#include <vector>

#include "dynamics/composite.hpp"

namespace jourdain::dynamics {

/// Accelerations that the inertia forces belong to, on top of the prescribed ones.
struct JointAccelerations {
  /// For each link: scalar kinds signed along z (or along the curve), about the axes of W for balls and free links.
  std::vector<Ex> scalar;
  std::vector<Vector3> spin;
  std::vector<Vector3> linear;  ///< of the origin of a free link less gravity where that counts, in W
  /// The part of `linear` whose force m a on the composite body belongs to the result; that of v̇ − gravity the caller
  /// adds in inertial axes, where it needs no rotation.
  std::vector<Vector3> inside;
  Vector3 ground;  ///< of the inertial frame's origin: −gravity makes gravity an inertia force
};

/// ω of each link and of its parent, in the working frame of the link.
struct AngularVelocities {
  std::vector<Vector3> parent, own;
};

AngularVelocities derive_angular_velocities(const kinematics::LinkTree& tree,
                                            const kinematics::WorkingFrames& frames,
                                            const std::vector<kinematics::LinkState>& states,
                                            kinematics::Statements& statements);

/// What the inertia forces of a tree do, link by link.
struct InertiaForces {
  /// Wrench on the composite body of the acceleration field that the link adds to its parent's.
  std::vector<Wrench> relative;
  /// Along each column of the link, of the parent's field on the composite body.
  std::vector<std::vector<Ex>> from_parent;
};

/// The acceleration field of link i differs from its parent's by Δa + ΔU (x − o_i), and so does that of every link
/// outward. With w the relative angular velocity, ω_p the parent's and v the relative velocity of the origin,
/// ΔU = [u][w] + [dw/dt], u = 2 ω_p + w, Δa = 2 ω_p × v + dv/dt. So a joint feels two things: the parent's field acting
/// on its composite body, of which only the components along its columns are computed, and the differences that it and
/// the joints outward make on their composite bodies, summed inward as wrenches. The composite bodies are those of the
/// mass matrix; no force of a single link is computed.
InertiaForces derive_inertia_forces(const kinematics::LinkTree& tree, const kinematics::WorkingFrames& frames,
                                    const std::vector<kinematics::LinkState>& states,
                                    const std::vector<CompositeBody>& composites,
                                    const AngularVelocities& omega, const JointAccelerations& accelerations,
                                    const std::string& name, kinematics::Statements& statements);

/// Generalized forces of all wrenches, one per column of each link: Σ J_tᵀ m a + J_rᵀ (I ω̇ + ω × I ω) − `applied`,
/// with `applied` wrenches (one per link, about its origin, in W) on the links.
std::vector<std::vector<Ex>> derive_generalized_forces(const kinematics::WorkingFrames& frames,
                                                       const std::vector<std::vector<Column>>& columns,
                                                       const InertiaForces& inertia,
                                                       const std::vector<Wrench>& applied,
                                                       const std::string& name,
                                                       kinematics::Statements& statements);

}  // namespace jourdain::dynamics
