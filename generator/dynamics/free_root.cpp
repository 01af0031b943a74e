#include "dynamics/free_root.hpp"

#include <fmt/format.h>

namespace jourdain::dynamics {

using kinematics::cross;

namespace {

std::vector<std::size_t> free_links(const Scene& scene) {
  std::vector<std::size_t> links;
  for (std::size_t i = 0; i < scene.link_count(); ++i)
    if (is_free(scene.tree.links[i])) links.push_back(i);
  return links;
}

/// v̇ of the child's origin, less gravity where that counts, in C.
Vector3 falling(const Scene& scene, std::size_t i, const std::vector<Ex>& zdot, Gravity gravity) {
  const std::size_t first = *scene.states[i].entry;
  Vector3 vdot = {zdot[first], zdot[first + 1], zdot[first + 2]};
  if (gravity == Gravity::kNone) return vdot;
  return scene.statements.bind(fmt::format("fall{}", i), vdot - scene.tree.gravity);
}

}  // namespace

Vector3 free_velocity(const Scene& scene, std::size_t i) {
  const kinematics::LinkState& state = scene.states[i];
  return transpose(scene.frames.R_CW(i)) * state.velocity + cross(state.spin, scene.tree.links[i].shift);
}

FreeAcceleration free_acceleration(const Scene& scene, std::size_t i, const std::vector<Ex>& zdot,
                                   Gravity gravity, const std::string& name) {
  if (zdot.empty()) return {};
  const std::size_t spin = *scene.states[i].entry + 3;
  const Vector3 v_W = scene.frames.from_C_to_W(i, falling(scene, i, zdot, gravity), name + "fallW");
  const Vector3 shifted =
      shift_acceleration(scene, i, {zdot[spin], zdot[spin + 1], zdot[spin + 2]}, fmt::format("shiftv{}", i));
  const Vector3 inside = scene.statements.bind(name + "inside", shifted);
  return {scene.statements.bind(name + "fallc", v_W + inside), inside};
}

Vector3 shift_acceleration(const Scene& scene, std::size_t i, const Vector3& spin_acceleration,
                           const std::string& name) {
  const Vector3 &d = scene.tree.links[i].shift, &w = scene.states[i].spin;
  const Vector3 velocity = scene.statements.bind(name, cross(w, d));
  return cross(spin_acceleration, d) + cross(w, velocity);
}

Wrench to_external(const Scene& scene, std::size_t i, const Wrench& wrench, const std::string& name) {
  const kinematics::Link& link = scene.tree.links[i];
  if (!is_free(link)) return wrench;
  const Vector3 force = scene.frames.from_W_to_C(i, wrench.force, name + "f");
  return {force, scene.statements.bind(name + "n", wrench.moment + cross(link.shift, wrench.force))};
}

std::vector<Ex> to_external(const Scene& scene, std::size_t i, const std::vector<Ex>& row,
                            const std::string& name) {
  if (!is_free(scene.tree.links[i])) return row;
  const auto& [f, n] = to_external(scene, i, {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}}, name);
  return {f[0], f[1], f[2], n[0], n[1], n[2]};
}

Wrench external_weight(const Scene& scene, std::size_t i, const Wrench& weight) {
  const kinematics::Link& link = scene.tree.links[i];
  if (!is_free(link)) return weight;
  return {scene.composites[i].moments.mass * scene.tree.gravity,
          weight.moment + cross(link.shift, weight.force)};
}

std::vector<std::vector<Ex>> with_free_blocks(const Scene& scene, std::vector<std::vector<Ex>> M) {
  for (const std::size_t i : free_links(scene)) {
    const std::size_t first = *scene.states[i].entry;
    const CompositeBody& body = scene.composites[i];
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) M[first + r][first + c] = r == c ? body.moments.mass : Ex(0);
    for (std::size_t c = 0; c < 3; ++c) {
      Vector3 axis = kinematics::zero_vector();
      axis[c] = 1;
      const std::string name = fmt::format("pfree_{}_{}", i, c);
      const Wrench moving = momentum(body, {axis, cross(axis, scene.tree.links[i].shift)});
      const Wrench seen =
          to_external(scene, i, {scene.statements.bind(name + "f", moving.force), moving.moment}, name);
      for (std::size_t r = 0; r < 3; ++r) {
        M[first + r][first + 3 + c] = M[first + 3 + c][first + r] = seen.force[r];
        if (r <= c) M[first + 3 + r][first + 3 + c] = M[first + 3 + c][first + 3 + r] = seen.moment[r];
      }
    }
  }
  return M;
}

std::vector<Ex> with_external_accelerations(const Scene& scene, std::vector<Ex> zdot) {
  for (const std::size_t i : free_links(scene)) {
    const std::size_t first = *scene.states[i].entry;
    const Vector3 linear_W = {zdot[first], zdot[first + 1], zdot[first + 2]};
    const Vector3 spin = {zdot[first + 3], zdot[first + 4], zdot[first + 5]};
    const Vector3 shifted = shift_acceleration(scene, i, spin, fmt::format("shiftv{}", i));
    const Vector3 at_origin = scene.statements.bind(fmt::format("ao{}", i), linear_W - shifted);
    const Vector3 turned = scene.frames.from_W_to_C(i, at_origin, fmt::format("vdot{}", i));
    for (std::size_t k = 0; k < 3; ++k)
      zdot[first + k] =
          scene.statements.bind(fmt::format("zdot_{}", first + k), turned[k] + scene.tree.gravity[k]);
  }
  return zdot;
}

std::vector<Ex> with_falling_mass(const Scene& scene, std::vector<Ex> tau) {
  for (const std::size_t i : free_links(scene)) {
    const std::size_t first = *scene.states[i].entry;
    const Ex& mass = scene.composites[i].moments.mass;
    const Vector3 fall_C = falling(scene, i, scene.leaves.zdot, Gravity::kAsAcceleration);
    const Vector3 fall_W = scene.frames.from_C_to_W(i, fall_C, fmt::format("fallm{}", i));
    const Vector3 lever = cross(mass * scene.tree.links[i].shift, fall_W);
    const auto add = [&](std::size_t entry, const Ex& push) {
      tau[entry] = scene.statements.bind(fmt::format("tauf{}", entry), tau[entry] + push);
    };
    for (std::size_t k = 0; k < 3; ++k) {
      add(first + k, mass * fall_C[k]);
      add(first + 3 + k, lever[k]);
    }
  }
  return tau;
}

Ex free_energy(const Scene& scene, std::size_t i) {
  kinematics::Statements& statements = scene.statements;
  const kinematics::LinkState& state = scene.states[i];
  const kinematics::Matrix3& R_CW = scene.frames.R_CW(i);
  const Vector3 shifted = statements.bind("Tshift", cross(state.spin, scene.tree.links[i].shift));
  const Vector3 v_C = statements.bind("Tv", state.velocity + R_CW * shifted);
  const Wrench turning = momentum(scene.composites[i], {state.spin, kinematics::zero_vector()});
  const Vector3 p_C = statements.bind("Tp", R_CW * statements.bind("Tph", turning.force));
  const Vector3 half = statements.bind("Tmv", scene.composites[i].moments.mass / 2 * v_C);
  return statements.bind("Tfree", dot(v_C, half + p_C) + dot(turning.moment, state.spin) / 2);
}

}  // namespace jourdain::dynamics
