#include "dynamics/accelerations.hpp"

#include <fmt/format.h>

#include "dynamics/free_root.hpp"

namespace jourdain::dynamics {

using kinematics::cross;
using kinematics::kGround;
using kinematics::Link;
using kinematics::Matrix3;

JointAccelerations joint_accelerations(const Scene& scene, const std::vector<Ex>& zdot, Gravity gravity,
                                       const std::string& name) {
  JointAccelerations motion;
  motion.ground =
      gravity == Gravity::kAsAcceleration ? Ex(-1) * scene.tree.gravity : kinematics::zero_vector();
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const Link& link = scene.tree.links[i];
    motion.scalar.push_back(0);
    motion.spin.push_back(kinematics::zero_vector());
    motion.free.emplace_back();
    if (is_free(link)) motion.free[i] = free_acceleration(scene, i, zdot, gravity, name);
    if (zdot.empty() || !scene.states[i].entry) continue;
    const std::size_t first = *scene.states[i].entry;
    if (!link.has_quaternion()) {
      motion.scalar[i] = link.sign * zdot[first];
      continue;
    }
    const std::size_t spin = first + scene.states[i].column_count(link) - 3;
    motion.spin[i] = {zdot[spin], zdot[spin + 1], zdot[spin + 2]};
  }
  return motion;
}

Matrix3 acceleration_gradient(const Vector3& omega, const Vector3& alpha, const std::string& name,
                              kinematics::Statements& statements) {
  Matrix3 products;  // ω ωᵀ, bound in a fixed order
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      products[i][j] = products[j][i] =
          statements.bind(fmt::format("{}w{}{}", name, i, j), omega[i] * omega[j]);
  Matrix3 U;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    U[i][i] = -products[j][j] - products[k][k];
    U[j][k] = products[j][k] - alpha[i];
    U[k][j] = products[j][k] + alpha[i];
  }
  return statements.bind(name + "U", U);
}

std::vector<Twist> link_accelerations(const Scene& scene, const std::vector<Ex>& zdot, Gravity gravity,
                                      const std::string& name) {
  return link_accelerations(scene, joint_accelerations(scene, zdot, gravity, name), name,
                            OriginField::kCrossProducts);
}

std::vector<Twist> link_accelerations(const Scene& scene, const JointAccelerations& motion,
                                      const std::string& name, OriginField field) {
  kinematics::Statements& statements = scene.statements;
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
      const Vector3 of_parent = in_C(result[p].linear, "p");
      if (field == OriginField::kGradient) {
        at.linear = statements.bind(a + "o", of_parent + acceleration_gradient(w, alpha, a, statements) * r);
      } else {
        const Vector3 wr = statements.bind(a + "wr", cross(w, r));
        at.linear = statements.bind(a + "o", of_parent + cross(alpha, r) + cross(w, wr));
      }
      at.angular = scene.frames.from_parent(i, result[p].angular, a + "n");
    }
    at.linear = scene.frames.from_C_to_W(i, at.linear, a + "t");
    if (motion.free[i]) at.linear = motion.free[i]->linear;

    const Vector3& w_p = scene.omega.parent[i];
    const Twist own = scene.relative_twist(i);
    Vector3 spin = motion.spin[i];
    const Ex scalar = statements.bind(a + "q", state.acceleration + motion.scalar[i]);
    if (link.turns_about_z()) spin[2] = spin[2] + scalar;
    at.angular = statements.bind(a + "A", at.angular + cross(w_p, own.angular) + spin);
    if (!link.has_quaternion()) {
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
