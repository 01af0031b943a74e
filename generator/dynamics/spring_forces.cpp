// Springs between the origins of two frames.
#include "dynamics/element_forces.hpp"
#include "kinematics/numbers.hpp"

namespace jourdain::dynamics {

using model::Variable;

namespace {

/// Length, rate and tension of a spring.
struct Stretch {
  kinematics::BodyPose from_pose, to_pose;
  PointPath from, to;  // seen from the common ancestor
  Vector3 difference;  // Δr from `from` to `to`, in W of the common ancestor
  Ex length_squared, length, rate;
};

Stretch stretch_of(const Scene& scene, const model::Spring& spring) {
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

Ex law_value(const Scene& scene, const std::string& name, const model::Expression& law, const Stretch& s) {
  return scene.statements.bind(
      name, kinematics::to_symbolic(law, scene.leaves.parameters, scene.statements,
                                    [&](const Variable& v) { return v.component == 0 ? s.length : s.rate; }));
}

/// Tension over length: the force on `to` is −that Δr, on `from` +that Δr.
Ex tension_per_length(const Scene& scene, const model::Spring& spring, const Stretch& s) {
  Ex stiffness = scene.value("stiffness", spring.stiffness);
  const Ex damping = scene.value("damping", spring.damping);
  const Ex free_length = scene.value("free_length", spring.free_length);
  if (spring.damping.is_zero() && spring.law.is_zero() && spring.free_length.is_zero()) return stiffness;
  const Ex elastic = scene.statements.bind(spring.name + "_e", s.length - free_length);
  const Ex law = law_value(scene, spring.name + "_law", spring.law, s);
  const Ex tension = scene.statements.bind(spring.name + "_T", stiffness * elastic + damping * s.rate + law);
  return scene.statements.bind(spring.name + "_Tl", tension / s.length);
}

}  // namespace

void add_forces(const model::Spring& spring, ForceSum& sum) {
  const Stretch s = stretch_of(sum.scene, spring);
  const Ex ratio = tension_per_length(sum.scene, spring, s);
  const Vector3 pull = sum.scene.statements.bind(spring.name + "f", ratio * s.difference);
  const std::vector<model::Frame>& frames = sum.scene.mechanism.frames;
  const Vector3 zero = kinematics::zero_vector();
  sum.act(frames[spring.from.value], s.from, {pull, zero}, spring.name + "fa");
  sum.act(frames[spring.to.value], s.to, {Ex(-1) * pull, zero}, spring.name + "fb");
}

Ex potential(const model::Spring& spring, const Scene& scene) {
  const Stretch s = stretch_of(scene, spring);
  const Ex stiffness = scene.value("half_stiffness", spring.stiffness) / 2;
  const Ex elastic =
      scene.statements.bind(spring.name + "_e", s.length - scene.value("free_length", spring.free_length));
  const Ex linear =
      spring.free_length.is_zero() ? Ex(stiffness * s.length_squared) : Ex(stiffness * elastic * elastic);
  return spring.potential ? linear + law_value(scene, spring.name + "_potential", *spring.potential, s)
                          : linear;
}

}  // namespace jourdain::dynamics
