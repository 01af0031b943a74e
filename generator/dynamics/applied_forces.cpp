#include "dynamics/applied_forces.hpp"

#include <fmt/format.h>

#include "kinematics/numbers.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Taylor;
using model::Variable;

namespace {

/// Position, velocity or spin of a frame, by component.
Ex frame_value(Scene& scene, const Variable& variable) {
  const model::Frame& frame = scene.mechanism.frames[variable.index];
  const kinematics::BodyPose pose = frame_pose(scene, frame);
  if (variable.kind == Variable::Kind::kFrameSpin) {
    if (pose.link == kGround) return 0;
    const Vector3 w = scene.frames.to_link(pose.link, scene.omega.own[pose.link], "spin_" + frame.name);
    return scene.statements.bind("spin_" + frame.name, (transpose(pose.R_LB) * w)[variable.component]);
  }
  const PointPath path = follow_point(scene, pose.link, pose.r_LB, kGround, frame.name);
  return variable.kind == Variable::Kind::kFramePosition ? path.position[variable.component]
                                                         : path.velocity[variable.component];
}

Ex variable_value(Scene& scene, const Variable& variable, Inputs inputs) {
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
    case Variable::Kind::kFramePosition:
    case Variable::Kind::kFrameVelocity:
    case Variable::Kind::kFrameSpin:
      return frame_value(scene, variable);
    case Variable::Kind::kArgument:
      break;
  }
  JD_CHECK(false, "an argument outside its function");
  return 0;
}

/// Length, rate and tension of a spring.
struct Stretch {
  kinematics::BodyPose from_pose, to_pose;
  PointPath from, to;  // seen from the common ancestor
  Vector3 difference;  // Δr from `from` to `to`, in W of the common ancestor
  Ex length_squared, length, rate;
};

Stretch stretch_of(Scene& scene, const model::Spring& spring) {
  kinematics::Statements& statements = scene.statements;
  const std::string& name = spring.name;
  Stretch s;
  s.from_pose = frame_pose(scene, scene.mechanism.frames[spring.from.value]);
  s.to_pose = frame_pose(scene, scene.mechanism.frames[spring.to.value]);
  const std::size_t ancestor = common_ancestor(scene.tree, s.from_pose.link, s.to_pose.link);
  s.from = follow_point(scene, s.from_pose.link, s.from_pose.r_LB, ancestor, name + "a");
  s.to = follow_point(scene, s.to_pose.link, s.to_pose.r_LB, ancestor, name + "b");
  s.difference = statements.bind(name + "d", s.to.position - s.from.position);
  const Vector3 velocity = statements.bind(name + "v", s.to.velocity - s.from.velocity);
  const Ex smoothing = kinematics::exact(model::kLengthSmoothing);
  s.length_squared = statements.bind(name + "_ll", dot(s.difference, s.difference) + smoothing * smoothing);
  s.length = statements.bind(name + "_l", kinematics::square_root(s.length_squared));
  s.rate = statements.bind(name + "_rate", dot(s.difference, velocity) / s.length);
  return s;
}

Ex law_value(Scene& scene, const std::string& name, const model::Expression& law, const Stretch& s) {
  return scene.statements.bind(
      name, kinematics::to_symbolic(law, scene.leaves.parameters, scene.statements,
                                    [&](const Variable& v) { return v.component == 0 ? s.length : s.rate; }));
}

class Applied {
 public:
  Applied(Scene& scene, Inputs inputs) : scene_(scene), statements_(scene.statements), inputs_(inputs) {
    forces_.on_link.resize(scene.link_count());
    for (const std::vector<Column>& columns : scene.columns) forces_.along.emplace_back(columns.size(), 0);
  }

  AppliedForces derive() {
    for (std::size_t i = 0; i < scene_.link_count(); ++i) add_joint_element(i);
    for (std::size_t k = 0; k < scene_.mechanism.actuators.size(); ++k) add_actuator(k);
    for (const model::CoordinateForce& force : scene_.mechanism.coordinate_forces)
      push(scene_.link_of(force.joint, force.coordinate), 0,
           general_value(scene_, force.name, force.force, inputs_));
    for (const model::Spring& spring : scene_.mechanism.springs) add_spring(spring);
    for (const model::Load& load : scene_.mechanism.loads) add_load(load);
    return std::move(forces_);
  }

 private:
  void push(std::size_t link, std::size_t column, const Ex& force) {
    Ex& sum = forces_.along[link][column];
    sum = statements_.bind(fmt::format("push{}_{}", link, column), sum + force);
  }

  void add_joint_element(std::size_t i) {
    const kinematics::Link& link = scene_.tree.links[i];
    const model::Joint& joint = scene_.mechanism.joints[link.joint.value];
    if (link.kind == kinematics::LinkKind::kBall) {
      const Ex damping = scene_.value("spin_damping", joint.spin_damping);
      for (std::size_t c = 0; c < 3; ++c) push(i, c, -damping * scene_.states[i].spin[c]);
    }
    if (link.has_quaternion()) return;
    const model::Coordinate& c = joint.coordinates[link.coordinate];
    const Taylor motion = kinematics::coordinate_motion(link, scene_.states[i]);
    const Ex stretch =
        statements_.bind(fmt::format("stretch{}", i), motion.value - scene_.value("rest", c.rest));
    const Ex stiffness = scene_.value("stiffness", c.stiffness);
    const Ex damping = scene_.value("damping", c.damping);
    push(i, 0, -(stiffness * stretch + damping * motion.first));
    if (c.friction.is_zero()) return;
    const Ex friction = scene_.value("friction", c.friction);
    const Ex speed = scene_.value("friction_speed", c.friction_speed);
    const Ex squares = statements_.bind("friction_vv", motion.first * motion.first + speed * speed);
    const Ex root = statements_.bind("friction_v", kinematics::square_root(squares));
    const Ex share = statements_.bind("friction_f", friction * motion.first);
    push(i, 0, -share / root);
  }

  void add_actuator(std::size_t k) {
    if (inputs_ == Inputs::kZero) return;
    const model::Actuator& actuator = scene_.mechanism.actuators[k];
    push(scene_.link_of(actuator.joint, actuator.coordinate), 0,
         scene_.value("gear", actuator.gear_ratio) * scene_.leaves.u[k]);
  }

  /// Tension over length: the force on `to` is −that Δr, on `from` +that Δr.
  Ex tension_per_length(const model::Spring& spring, const Stretch& s) {
    const Ex stiffness = scene_.value("stiffness", spring.stiffness);
    const Ex damping = scene_.value("damping", spring.damping);
    const Ex free_length = scene_.value("free_length", spring.free_length);
    if (spring.damping.is_zero() && spring.law.is_zero() && spring.free_length.is_zero()) return stiffness;
    const Ex elastic = statements_.bind(spring.name + "_e", s.length - free_length);
    const Ex law = law_value(scene_, spring.name + "_law", spring.law, s);
    const Ex tension = statements_.bind(spring.name + "_T", stiffness * elastic + damping * s.rate + law);
    return statements_.bind(spring.name + "_Tl", tension / s.length);
  }

  void add_spring(const model::Spring& spring) {
    const Stretch s = stretch_of(scene_, spring);
    const Ex ratio = tension_per_length(spring, s);
    const Vector3 pull = statements_.bind(spring.name + "f", ratio * s.difference);
    const std::vector<model::Frame>& frames = scene_.mechanism.frames;
    pull_at(frames[spring.from.value], s.from, pull, spring.name + "fa");
    pull_at(frames[spring.to.value], s.to, Ex(-1) * pull, spring.name + "fb");
  }

  /// A force at the end of a path: its share along each column on the way, and the wrench on the end's link.
  void pull_at(const model::Frame& frame, const PointPath& path, const Vector3& force,
               const std::string& name) {
    const std::vector<Vector3> carried = carry_outward(scene_, path, force, name);
    for (std::size_t k = 0; k < path.links.size(); ++k) {
      const Wrench wrench{carried[k], kinematics::cross(path.levers[k], carried[k])};
      for (std::size_t c = 0; c < scene_.columns[path.links[k]].size(); ++c)
        push(path.links[k], c, power(wrench, scene_.columns[path.links[k]][c].twist));
    }
    if (!frame.body) return;
    // A path that ends at the common ancestor itself has no link: there the force is in W of that link already.
    const bool at_ancestor = path.links.empty();
    const Vector3& f = at_ancestor ? force : carried.front();
    const Vector3& lever = at_ancestor ? path.position : path.levers.front();
    forces_.on_bodies.push_back({*frame.body, {f, statements_.bind(name + "n", cross(lever, f))}});
  }

  void add_load(const model::Load& load) {
    const model::Frame& frame = scene_.mechanism.frames[load.frame.value];
    const kinematics::BodyPose pose = frame_pose(scene_, frame);
    const auto components = [&](const model::Vector3& v, const char* what) {
      Vector3 value;
      for (std::size_t k = 0; k < 3; ++k) value[k] = general_value(scene_, load.name + what, v[k], inputs_);
      return value;
    };
    const Vector3 force = to_working(load, pose, components(load.force, "f"), load.name + "f");
    const Vector3 moment = to_working(load, pose, components(load.moment, "n"), load.name + "n");
    const Vector3 lever = scene_.frames.to_working(pose.link, pose.r_LB, load.name + "x");
    const Wrench wrench{force, statements_.bind(load.name + "m", moment + cross(lever, force))};
    if (frame.body) forces_.on_bodies.push_back({*frame.body, wrench});
    if (pose.link == kGround) return;
    Wrench& sum = forces_.on_link[pose.link];
    sum.force = statements_.bind(load.name + "sf", sum.force + wrench.force);
    sum.moment = statements_.bind(load.name + "sn", sum.moment + wrench.moment);
  }

  Vector3 to_working(const model::Load& load, const kinematics::BodyPose& pose, const Vector3& v,
                     const std::string& name) {
    if (load.axes == model::LoadAxes::kFrame)
      return scene_.frames.to_working(pose.link, statements_.bind(name, pose.R_LB * v), name);
    if (pose.link == kGround || (v[0].is_zero() && v[1].is_zero() && v[2].is_zero())) return v;
    const PointPath path = follow_point(scene_, pose.link, kinematics::zero_vector(), kGround, name);
    return carry_outward(scene_, path, v, name).front();
  }

  Scene& scene_;
  kinematics::Statements& statements_;
  Inputs inputs_;
  AppliedForces forces_;
};

}  // namespace

AppliedForces derive_applied_forces(Scene& scene, Inputs inputs) { return Applied(scene, inputs).derive(); }

Ex general_value(Scene& scene, const std::string& name, const model::Expression& expression, Inputs inputs) {
  return scene.statements.bind(
      name, kinematics::to_symbolic(expression, scene.leaves.parameters, scene.statements,
                                    [&](const Variable& v) { return variable_value(scene, v, inputs); }));
}

Ex derive_spring_energy(Scene& scene) {
  Ex energy = 0;
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const kinematics::Link& link = scene.tree.links[i];
    if (link.has_quaternion()) continue;
    const model::Coordinate& c = scene.mechanism.joints[link.joint.value].coordinates[link.coordinate];
    const Ex position = kinematics::coordinate_motion(link, scene.states[i]).value;
    const Ex stretch =
        scene.statements.bind(fmt::format("stretch{}", i), position - scene.value("rest", c.rest));
    energy = energy + scene.value("half_stiffness", c.stiffness) / 2 * stretch * stretch;
  }
  for (const model::Spring& spring : scene.mechanism.springs) {
    const Stretch s = stretch_of(scene, spring);
    const Ex stiffness = scene.value("half_stiffness", spring.stiffness) / 2;
    const Ex elastic =
        scene.statements.bind(spring.name + "_e", s.length - scene.value("free_length", spring.free_length));
    energy = energy + (spring.free_length.is_zero() ? Ex(stiffness * s.length_squared)
                                                    : Ex(stiffness * elastic * elastic));
    if (spring.potential)
      energy = energy + law_value(scene, spring.name + "_potential", *spring.potential, s);
  }
  return energy;
}

}  // namespace jourdain::dynamics
