// The mechanism with everything that the equations are built from: leaves, links, frames, composite bodies.
#pragma once

#include <vector>

#include "dynamics/inertia_forces.hpp"

namespace jourdain::dynamics {

using kinematics::Ex;

/// Members are the stages' results, filled in by the constructor in order; later stages bind more `statements`.
struct Scene {
  Scene(const model::Mechanism& mechanism, const kinematics::LinkTreeOptions& options);
  Scene(const Scene&) = delete;

  const model::Mechanism& mechanism;
  model::CoordinateLayout layout;
  kinematics::Statements statements;
  kinematics::Leaves leaves;
  kinematics::LinkTree tree;
  std::vector<kinematics::LinkState> states;
  kinematics::WorkingFrames frames;
  std::vector<CompositeBody> composites;
  AngularVelocities omega;
  std::vector<std::vector<Column>> columns;  ///< by link

  std::size_t link_count() const { return tree.links.size(); }
  /// The link that a scalar coordinate of a joint belongs to.
  std::size_t link_of(model::JointIndex joint, std::size_t coordinate) const;

  /// Motion of a link relative to its parent, at the link's origin, in W. A free link's includes all its velocity.
  Twist relative_twist(std::size_t link);

  Ex value(const std::string& name, const model::Expression& expression);
};

/// Rows of a free link (force and moment about the origin of L, in W) as those of its velocities v (inertial frame) and
/// ω (child axes) of the child's origin.
Wrench to_external(Scene& scene, std::size_t link, const Wrench& wrench, const std::string& name);

}  // namespace jourdain::dynamics
