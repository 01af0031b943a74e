#include "dynamics/scene.hpp"

#include <fmt/format.h>

#include "support/check.hpp"

namespace jourdain::dynamics {

using kinematics::LinkKind;

namespace {

std::vector<std::vector<Column>> all_columns(const kinematics::LinkTree& tree,
                                             const std::vector<kinematics::LinkState>& states,
                                             const kinematics::WorkingFrames& frames) {
  std::vector<std::vector<Column>> columns;
  for (std::size_t i = 0; i < tree.links.size(); ++i)
    columns.push_back(derive_columns(tree.links[i], states[i], frames, i));
  return columns;
}

}  // namespace

Scene::Scene(const model::Mechanism& model, const kinematics::LinkTreeOptions& options)
    : mechanism(model),
      layout(model::lay_out_coordinates(model)),
      leaves(model, layout, statements),
      tree(kinematics::build_link_tree(model, leaves.parameters, statements, options)),
      states(kinematics::derive_link_states(model, layout, tree, leaves, statements)),
      frames(tree, states, statements),
      composites(derive_composites(tree, frames, statements, [](std::size_t) { return Joins::kRigid; })),
      omega(derive_angular_velocities(tree, frames, states, statements)),
      columns(all_columns(tree, states, frames)) {}

std::size_t Scene::link_of(model::JointIndex joint, std::size_t coordinate) const {
  for (std::size_t i = 0; i < tree.links.size(); ++i)
    if (tree.links[i].joint == joint && tree.links[i].coordinate == coordinate) return i;
  JD_CHECK(false, "joint {} has no coordinate {}", joint.value, coordinate);
  return 0;
}

Twist Scene::relative_twist(std::size_t i) {
  const kinematics::Link& link = tree.links[i];
  const kinematics::LinkState& state = states[i];
  Twist twist;
  if (link.turns_about_z()) twist.angular[2] = state.rate;
  if (link.has_quaternion()) twist.angular = state.spin;
  const std::string name = fmt::format("vrel{}", i);
  if (link.kind == LinkKind::kFree) {
    const Vector3 shifted = kinematics::cross(state.spin, link.shift);
    twist.linear = statements.bind(name, transpose(frames.R_CW(i)) * state.velocity + shifted);
  } else {
    twist.linear = statements.bind(name, state.rate * frames.direction(i));
  }
  return twist;
}

Ex Scene::value(const std::string& name, const model::Expression& expression) {
  return statements.bind(name, kinematics::to_symbolic(expression, leaves.parameters, statements));
}

Wrench to_external(Scene& scene, std::size_t link, const Wrench& wrench, const std::string& name) {
  const Vector3 lever = kinematics::cross(scene.tree.links[link].shift, wrench.force);
  return {scene.statements.bind(name + "f", scene.frames.R_CW(link) * wrench.force),
          scene.statements.bind(name + "n", wrench.moment + lever)};
}

}  // namespace jourdain::dynamics
