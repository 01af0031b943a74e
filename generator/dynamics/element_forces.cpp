#include "dynamics/element_forces.hpp"

#include <fmt/format.h>

#include "kinematics/numbers.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Taylor;
using model::Variable;

namespace {

/// A vector in the working frame of a link, in the axes of the inertial frame.
Vector3 in_world(const Scene& scene, std::size_t link, Vector3 v, const std::string& name) {
  for (std::size_t j = link; j != kGround; j = scene.tree.links[j].parent)
    v = scene.frames.to_parent(j, v, fmt::format("{}_{}", name, j));
  return v;
}

Vector3 world_spin(const Scene& scene, const kinematics::BodyPose& pose, const std::string& name) {
  if (pose.link == kGround) return kinematics::zero_vector();
  return in_world(scene, pose.link, scene.omega.own[pose.link], "spin_" + name);
}

/// Of an axis of a frame, given in its link, the components in the inertial one.
Vector3 world_direction(const Scene& scene, std::size_t link, const Vector3& axis, const std::string& name) {
  return link == kGround ? axis : in_world(scene, link, scene.frames.to_working(link, axis, name), name);
}

/// Position, velocity, spin or direction of a frame, by component.
Ex frame_value(const Scene& scene, const Variable& variable) {
  const model::Frame& frame = scene.mechanism.frames[variable.index];
  const kinematics::BodyPose pose = frame_pose(scene, frame);
  if (variable.kind == Variable::Kind::kFrameSpin) {
    if (pose.link == kGround) return 0;
    const Vector3 w = scene.frames.to_link(pose.link, scene.omega.own[pose.link], "spin_" + frame.name);
    return scene.statements.bind("spin_" + frame.name, (transpose(pose.R_LB) * w)[variable.component]);
  }
  if (variable.kind == Variable::Kind::kFrameDirection) {
    const std::size_t of = variable.component / 3, axis = variable.component % 3;
    return world_direction(scene, pose.link, transpose(pose.R_LB)[axis],
                           fmt::format("{}_{}", "xyz"[axis], frame.name))[of];
  }
  if (variable.kind == Variable::Kind::kFrameWorldSpin)
    return world_spin(scene, pose, frame.name)[variable.component];
  const PointPath path = follow_point(scene, pose.link, pose.r_LB, kGround, frame.name);
  return variable.kind == Variable::Kind::kFramePosition ? path.position[variable.component]
                                                         : path.velocity[variable.component];
}

Ex variable_value(const Scene& scene, const Variable& variable, Inputs inputs) {
  switch (variable.kind) {
    case Variable::Kind::kTime:
      return scene.leaves.t;
    case Variable::Kind::kInput:
      return inputs == Inputs::kGiven ? scene.leaves.u[variable.index] : Ex(0);
    case Variable::Kind::kPosition:
    case Variable::Kind::kVelocity: {
      const std::size_t link = scene.link_of(model::JointIndex(variable.index), variable.component);
      const Taylor motion = kinematics::coordinate_motion(scene.tree.links[link], scene.states[link]);
      return variable.kind == Variable::Kind::kPosition ? motion.value : motion.first;
    }
    case Variable::Kind::kStepLength:
      return scene.leaves.h;
    case Variable::Kind::kState:
      return scene.leaves.z[scene.layout.first_state() + variable.index];
    case Variable::Kind::kFramePosition:
    case Variable::Kind::kFrameVelocity:
    case Variable::Kind::kFrameSpin:
    case Variable::Kind::kFrameWorldSpin:
    case Variable::Kind::kFrameDirection:
      return frame_value(scene, variable);
    case Variable::Kind::kArgument:
      break;
  }
  JD_CHECK(false, "an argument outside its function");
  return 0;
}

}  // namespace

ForceSum::ForceSum(const Scene& of, Inputs given) : scene(of), inputs(given) {
  forces.on_link.resize(scene.link_count());
  for (const std::vector<Column>& columns : scene.columns) forces.along.emplace_back(columns.size(), 0);
}

void ForceSum::push(std::size_t link, std::size_t column, const Ex& force) {
  Ex& sum = forces.along[link][column];
  sum = scene.statements.bind(fmt::format("push{}_{}", link, column), sum + force);
}

void ForceSum::act(const model::Frame& frame, const PointPath& path, const Wrench& wrench,
                   const std::string& name) {
  const std::vector<Vector3> force = carry_outward(scene, path, wrench.force, name),
                             moment = carry_outward(scene, path, wrench.moment, name + "m");
  for (std::size_t k = 0; k < path.links.size(); ++k) {
    const Wrench here{force[k], moment[k] + kinematics::cross(path.levers[k], force[k])};
    for (std::size_t c = 0; c < scene.columns[path.links[k]].size(); ++c)
      push(path.links[k], c, power(here, scene.columns[path.links[k]][c].twist));
  }
  if (!frame.body) return;
  // A path that ends at the common ancestor itself has no link: there the wrench is in W of that link already.
  const bool at_ancestor = path.links.empty();
  const Vector3 &f = at_ancestor ? wrench.force : force.front(),
                &n = at_ancestor ? wrench.moment : moment.front();
  const Vector3& lever = at_ancestor ? path.position : path.levers.front();
  forces.on_bodies.push_back(
      {*frame.body, {f, scene.statements.bind(name + "n", n + kinematics::cross(lever, f))}});
}

Ex general_value(const Scene& scene, const std::string& name, const model::Expression& expression,
                 Inputs inputs) {
  return scene.statements.bind(
      name, kinematics::to_symbolic(expression, scene.leaves.parameters, scene.statements,
                                    [&](const Variable& v) { return variable_value(scene, v, inputs); }));
}

void add_forces(const model::Actuator& actuator, ForceSum& sum) {
  if (sum.inputs == Inputs::kZero) return;
  const auto input = std::size_t(&actuator - sum.scene.mechanism.actuators.data());
  sum.push(sum.scene.link_of(actuator.joint, actuator.coordinate), 0,
           sum.scene.value("gear", actuator.gear_ratio) * sum.scene.leaves.u[input]);
}

void add_forces(const model::CoordinateForce& force, ForceSum& sum) {
  sum.push(sum.scene.link_of(force.joint, force.coordinate), 0,
           general_value(sum.scene, force.name, force.force, sum.inputs));
}

void add_forces(const model::StateVariable& state, ForceSum& sum) {
  sum.forces.on_states.push_back(general_value(sum.scene, state.name, state.rate, sum.inputs));
}

}  // namespace jourdain::dynamics
