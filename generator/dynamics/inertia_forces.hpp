// Generalized inertia forces of a tree by one outward and one inward recursion on composite bodies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// Of the origin of a free link, in W.
struct FreeAcceleration {
  Vector3 linear = kinematics::zero_vector();  ///< less gravity where that counts
  /// The part of `linear` whose force m a on the composite body belongs to the result; that of v̇ − gravity is added in
  /// inertial axes, where it needs no rotation.
  Vector3 inside = kinematics::zero_vector();
};

/// Accelerations that the inertia forces belong to, on top of the prescribed ones.
struct JointAccelerations {
  /// For each link: scalar kinds signed along z (or along the curve), about the axes of W for balls and free links.
  std::vector<Ex> scalar;
  std::vector<Vector3> spin;
  std::vector<std::optional<FreeAcceleration>> free;  ///< for each link: of those that are free
  Vector3 ground;  ///< of the inertial frame's origin: −gravity makes gravity an inertia force
};

/// The acceleration field of link i differs from its parent's by Δa + ΔU (x − o_i), and so does that of every link
/// outward. With w the relative angular velocity, ω_p the parent's and v the relative velocity of the origin,
/// ΔU = [u][w] + [dw/dt], u = 2 ω_p + w, Δa = 2 ω_p × v + dv/dt. So a joint feels two things: the parent's field acting
/// on its composite body, of which only the components along its columns are computed, and the differences that it and
/// the joints outward make on their composite bodies, summed inward as wrenches. The composite bodies are those of the
/// mass matrix; no force of a single link is computed.
///
/// Along each column of each link: Σ J_tᵀ m a + J_rᵀ (I ω̇ + ω × I ω) − `applied`, with `applied` wrenches (one per
/// link, about its origin, in W) on the links.
std::vector<std::vector<Ex>> derive_generalized_forces(const Scene& scene,
                                                       const JointAccelerations& accelerations,
                                                       const std::vector<Wrench>& applied,
                                                       const std::string& name);

/// Of each link, about its origin, in W: inertia forces of the difference field on its composite body. The sum over a
/// subtree on the ground is the rate of its momentum, gravity not counted.
std::vector<Wrench> derive_relative_inertia_forces(const Scene& scene,
                                                   const JointAccelerations& accelerations,
                                                   const std::string& name);

}  // namespace jourdain::dynamics
