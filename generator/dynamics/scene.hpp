// The mechanism with everything that the equations are built from: leaves, links, frames, composite bodies.
#pragma once

#include <vector>

#include "dynamics/composite.hpp"

namespace jourdain::dynamics {

/// ω of each link and of its parent, in the working frame of the link.
struct AngularVelocities {
  std::vector<Vector3> parent, own;
};

/// Members are the stages' results, filled in by the constructor in order. What is derived from them binds more
/// `statements`, and changes nothing else.
struct Scene {
  Scene(const model::Mechanism& mechanism, const kinematics::LinkTreeOptions& options,
        kinematics::Statements& statements);
  Scene(const Scene&) = delete;

  const model::Mechanism& mechanism;
  model::CoordinateLayout layout;
  kinematics::Statements& statements;
  kinematics::Leaves leaves;
  kinematics::LinkTree tree;
  std::vector<kinematics::LinkState> states;
  kinematics::WorkingFrames frames;
  std::vector<CompositeBody> composites;
  AngularVelocities omega;
  std::vector<std::vector<Column>> columns;  ///< by link

  std::size_t link_count() const { return tree.links.size(); }
  bool turns(std::size_t link) const { return tree.links[link].kind == kinematics::LinkKind::kTurn; }
  /// The link that a scalar coordinate of a joint belongs to.
  std::size_t link_of(model::JointIndex joint, std::size_t coordinate) const;

  /// Motion of a link relative to its parent, at the link's origin, in W. A free link's includes all its velocity.
  Twist relative_twist(std::size_t link) const;

  Ex value(const std::string& name, const model::Expression& expression) const;
};

}  // namespace jourdain::dynamics
