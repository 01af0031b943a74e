#include "dynamics/scene.hpp"

#include <fmt/format.h>

#include "dynamics/free_root.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

namespace {

AngularVelocities derive_angular_velocities(const kinematics::LinkTree& tree,
                                            const kinematics::WorkingFrames& frames,
                                            const std::vector<kinematics::LinkState>& states,
                                            kinematics::Statements& statements) {
  AngularVelocities omega;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const kinematics::Link& link = tree.links[i];
    const std::string w = fmt::format("w{}", i);
    omega.parent.push_back(link.parent == kinematics::kGround
                               ? kinematics::zero_vector()
                               : frames.from_parent(i, omega.own[link.parent], w + "p"));
    omega.own.push_back(omega.parent[i]);
    if (link.turns_about_z())
      omega.own[i][2] = statements.bind(w + "_z", omega.parent[i][2] + states[i].rate);
    if (link.has_quaternion()) omega.own[i] = statements.bind(w, omega.parent[i] + states[i].spin);
  }
  return omega;
}

}  // namespace

Scene::Scene(const model::Mechanism& model, const kinematics::LinkTreeOptions& options,
             kinematics::Statements& record)
    : mechanism(model),
      layout(model::lay_out_coordinates(model)),
      statements(record),
      leaves(model, layout, statements),
      tree(kinematics::build_link_tree(model, leaves.parameters, statements, options)),
      states(kinematics::derive_link_states(model, layout, tree, leaves, statements)),
      frames(tree, states, statements),
      composites(derive_composites(tree, frames, statements, [](std::size_t) { return Joins::kRigid; })),
      omega(derive_angular_velocities(tree, frames, states, statements)),
      columns(derive_columns(tree, states, frames)) {}

std::size_t Scene::link_of(model::JointIndex joint, std::size_t coordinate) const {
  for (std::size_t i = 0; i < tree.links.size(); ++i)
    if (tree.links[i].joint == joint && tree.links[i].coordinate == coordinate) return i;
  JD_CHECK(false, "joint {} has no coordinate {}", joint.value, coordinate);
  return 0;
}

Twist Scene::relative_twist(std::size_t i) const {
  const kinematics::Link& link = tree.links[i];
  const kinematics::LinkState& state = states[i];
  Twist twist;
  if (link.turns_about_z()) twist.angular[2] = state.rate;
  if (link.has_quaternion()) twist.angular = state.spin;
  const Vector3 linear = is_free(link) ? free_velocity(*this, i) : state.rate * frames.direction(i);
  twist.linear = statements.bind(fmt::format("vrel{}", i), linear);
  return twist;
}

Ex Scene::value(const std::string& name, const model::Expression& expression) const {
  return statements.bind(name, kinematics::to_symbolic(expression, leaves.parameters, statements));
}

}  // namespace jourdain::dynamics
