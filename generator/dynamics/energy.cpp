#include "dynamics/energy.hpp"

#include <fmt/format.h>

#include "dynamics/applied_forces.hpp"
#include "dynamics/free_root.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;

Ex derive_kinetic_energy(const Scene& scene) {
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
    if (is_free(link))
      energy = statements.bind("T", energy + free_energy(scene, i));
    else
      energy = statements.bind(fmt::format("T{}", i), energy + (half + power(moving, parent)));
    velocity.push_back(statements.bind(v + "s", parent.linear + own.linear));
  }
  return with_rotor_energy(scene, energy);
}

Ex with_rotor_energy(const Scene& scene, Ex energy) {
  for (const model::Actuator& actuator : scene.mechanism.actuators) {
    if (actuator.rotor_inertia.is_zero()) continue;
    const Ex rate = scene.states[scene.link_of(actuator.joint, actuator.coordinate)].rate;
    energy = scene.statements.bind("T_rotor", energy + reflected_inertia(scene, actuator) / 2 * rate * rate);
  }
  return energy;
}

Ex derive_potential_energy(const Scene& scene) {
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

Ex reflected_inertia(const Scene& scene, const model::Actuator& actuator) {
  const Ex gear = scene.value("gear", actuator.gear_ratio);
  return scene.statements.bind("reflected", gear * gear * scene.value("rotor", actuator.rotor_inertia));
}

}  // namespace jourdain::dynamics
