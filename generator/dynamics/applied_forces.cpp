#include "dynamics/applied_forces.hpp"

#include <fmt/format.h>

#include <utility>

#include "kinematics/numbers.hpp"

namespace jourdain::dynamics {

using kinematics::Taylor;

namespace {

/// Springs, dampers and friction of the joint that link i hangs on.
void add_joint_element(std::size_t i, ForceSum& sum) {
  const Scene& scene = sum.scene;
  const kinematics::Link& link = scene.tree.links[i];
  const model::Joint& joint = scene.mechanism.joints[link.joint.value];
  if (link.kind == kinematics::LinkKind::kBall) {
    const Ex damping = scene.value("spin_damping", joint.spin_damping);
    for (std::size_t c = 0; c < 3; ++c) sum.push(i, c, -damping * scene.states[i].spin[c]);
  }
  if (link.has_quaternion()) return;
  const model::Coordinate& c = joint.coordinates[link.coordinate];
  const Taylor motion = kinematics::coordinate_motion(link, scene.states[i]);
  const Ex stretch =
      scene.statements.bind(fmt::format("stretch{}", i), motion.value - scene.value("rest", c.rest));
  const Ex stiffness = scene.value("stiffness", c.stiffness);
  const Ex damping = scene.value("damping", c.damping);
  sum.push(i, 0, -(stiffness * stretch + damping * motion.first));
  if (c.friction.is_zero()) return;
  const Ex friction = scene.value("friction", c.friction);
  const Ex speed = scene.value("friction_speed", c.friction_speed);
  const Ex squares = scene.statements.bind("friction_vv", motion.first * motion.first + speed * speed);
  const Ex root = scene.statements.bind("friction_v", kinematics::square_root(squares));
  const Ex share = scene.statements.bind("friction_f", friction * motion.first);
  sum.push(i, 0, -share / root);
}

}  // namespace

AppliedForces derive_applied_forces(const Scene& scene, Inputs inputs) {
  ForceSum sum(scene, inputs);
  for (std::size_t i = 0; i < scene.link_count(); ++i) add_joint_element(i, sum);
  for_each_force_element(scene.mechanism, [&sum](const auto& element) { add_forces(element, sum); });
  return std::move(sum.forces);
}

Ex derive_elastic_energy(const Scene& scene) {
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
  for_each_force_element(scene.mechanism,
                         [&](const auto& element) { energy = energy + potential(element, scene); });
  return energy;
}

}  // namespace jourdain::dynamics
