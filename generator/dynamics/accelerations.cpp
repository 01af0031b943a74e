#include "dynamics/accelerations.hpp"

#include <fmt/format.h>

namespace jourdain::dynamics {

using kinematics::cross;
using kinematics::kGround;
using kinematics::Link;
using kinematics::LinkKind;

Vector3 shift_acceleration(Scene& scene, std::size_t i, const Vector3& spin_acceleration) {
  const Vector3& d = scene.tree.links[i].shift;
  const Vector3& w = scene.states[i].spin;
  const Vector3 velocity = scene.statements.bind(fmt::format("shiftv{}", i), cross(w, d));
  return cross(spin_acceleration, d) + cross(w, velocity);
}

Vector3 falling(Scene& scene, std::size_t i, const std::vector<Ex>& zdot, Gravity gravity) {
  const std::size_t first = *scene.states[i].entry;
  const Vector3 vdot = {zdot[first], zdot[first + 1], zdot[first + 2]};
  if (gravity == Gravity::kNone) return vdot;
  return scene.statements.bind(fmt::format("fall{}", i), vdot - scene.tree.gravity);
}

namespace {

/// A free link falls with gravity when its linear acceleration is zero.
void set_free_acceleration(Scene& scene, std::size_t i, const std::vector<Ex>& zdot, Gravity gravity,
                           const std::string& name, JointAccelerations& motion) {
  const Vector3 v_W = scene.statements.bind(
      name + "fallW", transpose(scene.frames.R_CW(i)) * falling(scene, i, zdot, gravity));
  motion.inside[i] = scene.statements.bind(name + "inside", shift_acceleration(scene, i, motion.spin[i]));
  motion.linear[i] = scene.statements.bind(name + "fallc", v_W + motion.inside[i]);
}

}  // namespace

JointAccelerations joint_accelerations(Scene& scene, const std::vector<Ex>& zdot, Gravity gravity,
                                       const std::string& name) {
  JointAccelerations motion;
  motion.ground =
      gravity == Gravity::kAsAcceleration ? Ex(-1) * scene.tree.gravity : kinematics::zero_vector();
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const Link& link = scene.tree.links[i];
    motion.scalar.push_back(0);
    motion.spin.push_back(kinematics::zero_vector());
    motion.linear.push_back(kinematics::zero_vector());
    motion.inside.push_back(kinematics::zero_vector());
    if (zdot.empty() || !scene.states[i].entry) continue;
    const std::size_t first = *scene.states[i].entry;
    if (!link.has_quaternion()) {
      motion.scalar[i] = link.sign * zdot[first];
      continue;
    }
    const std::size_t spin = first + (link.kind == LinkKind::kFree ? 3 : 0);
    motion.spin[i] = {zdot[spin], zdot[spin + 1], zdot[spin + 2]};
    if (link.kind == LinkKind::kFree) set_free_acceleration(scene, i, zdot, gravity, name, motion);
  }
  return motion;
}

std::vector<Twist> link_accelerations(Scene& scene, const std::vector<Ex>& zdot, Gravity gravity,
                                      const std::string& name) {
  kinematics::Statements& statements = scene.statements;
  const JointAccelerations motion = joint_accelerations(scene, zdot, gravity, name);
  std::vector<Twist> result;
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const Link& link = scene.tree.links[i];
    const kinematics::LinkState& state = scene.states[i];
    const std::string a = fmt::format("{}la{}", name, i);
    Twist at{kinematics::zero_vector(), motion.ground};
    if (link.parent != kGround) {
      const std::size_t p = link.parent;
      const auto in_C = [&](const Vector3& v, const char* what) {
        return scene.frames.from_parent_to_C(i, v, a + what);
      };
      const Vector3 w = in_C(scene.omega.own[p], "w"), alpha = in_C(result[p].angular, "al");
      const Vector3& r = scene.frames.r_CW(i);
      const Vector3 wr = statements.bind(a + "wr", cross(w, r));
      at.linear = statements.bind(a + "o", in_C(result[p].linear, "p") + cross(alpha, r) + cross(w, wr));
      at.angular = scene.frames.from_parent(i, result[p].angular, a + "n");
    }
    at.linear = scene.frames.from_C_to_W(i, at.linear, a + "t");
    if (link.kind == LinkKind::kFree) at.linear = motion.linear[i];

    const Vector3& w_p = scene.omega.parent[i];
    const Twist own = scene.relative_twist(i);
    Vector3 spin = motion.spin[i];
    const Ex scalar = statements.bind(a + "q", state.acceleration + motion.scalar[i]);
    if (link.turns_about_z()) spin[2] = spin[2] + scalar;
    at.angular = statements.bind(a + "A", at.angular + cross(w_p, own.angular) + spin);
    if (link.kind != LinkKind::kFree && !link.has_quaternion()) {
      const Ex square = statements.bind(a + "zz", state.rate * state.rate);
      const Vector3 coriolis = statements.bind(a + "co", Ex(2) * cross(w_p, own.linear));
      at.linear = statements.bind(a + "L", at.linear + coriolis + scalar * scene.frames.direction(i) +
                                               square * scene.frames.curvature(i));
    }
    result.push_back(at);
  }
  return result;
}

}  // namespace jourdain::dynamics
