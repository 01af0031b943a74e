#include "dynamics/energy.hpp"

#include <fmt/format.h>

#include "dynamics/applied_forces.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;

namespace {

/// ½ m |v|² + v · R (ω × h) + ½ ω · J ω with v the velocity of the origin of L in inertial axes, where it
/// needs no rotation if L is the child's frame.
Ex free_energy(Scene& scene, std::size_t i) {
  kinematics::Statements& statements = scene.statements;
  const kinematics::LinkState& state = scene.states[i];
  const Vector3 shifted = statements.bind("Tshift", kinematics::cross(state.spin, scene.tree.links[i].shift));
  const Vector3 v = statements.bind("Tv", state.velocity + scene.frames.R_CW(i) * shifted);
  const Wrench turning = momentum(scene.composites[i], {state.spin, kinematics::zero_vector()});
  const Vector3 p = statements.bind("Tp", scene.frames.R_CW(i) * statements.bind("Tph", turning.force));
  const Ex mass = scene.composites[i].moments.mass;
  const Vector3 half = statements.bind("Tmv", mass / 2 * v);
  return statements.bind("Tfree",
                         kinematics::dot(v, half + p) + kinematics::dot(turning.moment, state.spin) / 2);
}

}  // namespace

Ex derive_kinetic_energy(Scene& scene) {
  kinematics::Statements& statements = scene.statements;
  std::vector<Vector3> velocity;  // of the link's origin, in W
  Ex energy = 0;
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const Link& link = scene.tree.links[i];
    const std::string v = fmt::format("v{}", i);
    Twist parent{scene.omega.parent[i], kinematics::zero_vector()};
    if (link.parent != kGround) {
      const std::size_t p = link.parent;
      const Vector3 omega_C = scene.frames.from_parent_to_C(i, scene.omega.own[p], v + "w");
      const Vector3 v_C = scene.frames.from_parent_to_C(i, velocity[p], v + "p");
      const Vector3 at_origin =
          statements.bind(v + "o", v_C + kinematics::cross(omega_C, scene.frames.r_CW(i)));
      parent.linear = scene.frames.from_C_to_W(i, at_origin, v);
    }
    const Twist own = scene.relative_twist(i);
    Wrench moving = momentum(scene.composites[i], own);
    moving = {statements.bind(v + "P", moving.force), statements.bind(v + "L", moving.moment)};
    const Ex half = statements.bind(v + "T", power(moving, own) / 2);
    if (link.kind == kinematics::LinkKind::kFree)
      energy = statements.bind("T", energy + free_energy(scene, i));
    else
      energy = statements.bind(fmt::format("T{}", i), energy + (half + power(moving, parent)));
    velocity.push_back(statements.bind(v + "s", parent.linear + own.linear));
  }
  for (const model::Actuator& actuator : scene.mechanism.actuators) {
    if (actuator.rotor_inertia.is_zero()) continue;
    const Ex rate = scene.states[scene.link_of(actuator.joint, actuator.coordinate)].rate;
    energy = statements.bind("T_rotor", energy + reflected_inertia(scene, actuator) / 2 * rate * rate);
  }
  return energy;
}

Ex derive_potential_energy(Scene& scene) {
  Vector3 first = scene.tree.ground.first;
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    if (scene.tree.links[i].parent != kGround) continue;
    const kinematics::MassMoments& moments = scene.composites[i].moments;
    first = scene.statements.bind(fmt::format("hg{}", i), first + (scene.frames.R_CW(i) * moments.first +
                                                                   moments.mass * scene.frames.r_CW(i)));
  }
  const Ex elastic = derive_elastic_energy(scene);
  return scene.statements.bind("V", elastic - kinematics::dot(scene.tree.gravity, first));
}

Ex reflected_inertia(Scene& scene, const model::Actuator& actuator) {
  const Ex gear = scene.value("gear", actuator.gear_ratio);
  return scene.statements.bind("reflected", gear * gear * scene.value("rotor", actuator.rotor_inertia));
}

}  // namespace jourdain::dynamics
