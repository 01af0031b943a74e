#include "dynamics/moving_vector.hpp"

#include <fmt/format.h>

#include "dynamics/free_root.hpp"
#include "kinematics/numbers.hpp"

namespace jourdain::dynamics {

namespace {

/// What the turning of link j relative to its parent adds to the change of a vector, all in W. With w the relative
/// angular velocity and α its prescribed change: v̇ + w × v, v̈ + α × v + w × (w × v + 2 v̇).
MovingVector with_turning(const Scene& scene, std::size_t j, const MovingVector& v, const std::string& name) {
  const kinematics::Link& link = scene.tree.links[j];
  if (!link.turns_about_z() && !link.has_quaternion()) return v;
  const Vector3 w = scene.relative_twist(j).angular;
  const Vector3 alpha = {0, 0, link.turns_about_z() ? scene.states[j].acceleration : Ex(0)};
  const Vector3 turned = scene.statements.bind(name + "t", cross(w, v.value));
  const Vector3 both = scene.statements.bind(name + "b", turned + Ex(2) * v.first);
  const Vector3 second = scene.statements.bind(name + "a", v.second + cross(alpha, v.value) + cross(w, both));
  return {v.value, scene.statements.bind(name + "v", v.first + turned), second};
}

/// The same of its translation.
MovingVector with_sliding(const Scene& scene, std::size_t j, const MovingVector& v, const std::string& name) {
  const kinematics::LinkState& state = scene.states[j];
  const Vector3 first = scene.statements.bind(name + "vl", v.first + scene.relative_twist(j).linear);
  const Vector3 shifted = shift_acceleration(scene, j, kinematics::zero_vector(), name + "s");
  const Ex square = scene.statements.bind(name + "zz", state.rate * state.rate);
  const Vector3 own =
      state.acceleration * scene.frames.direction(j) + square * scene.frames.curvature(j) + shifted;
  return {v.value, first, scene.statements.bind(name + "al", v.second + own)};
}

MovingVector change_to_parent(const Scene& scene, std::size_t j, const MovingVector& v,
                              const std::string& name) {
  const Vector3 first = scene.frames.to_parent(j, v.first, name + "vp");
  return {v.value, first, scene.frames.to_parent(j, v.second, name + "ap")};
}

}  // namespace

MovingVector moving_point(const Scene& scene, const PointPath& path, const std::string& name) {
  MovingVector x;
  for (std::size_t k = 0; k < path.links.size(); ++k) {
    const std::size_t j = path.links[k];
    const std::string here = fmt::format("{}{}", name, j);
    x.value = path.levers[k];
    x = change_to_parent(scene, j, with_sliding(scene, j, with_turning(scene, j, x, here), here), here);
  }
  return {path.position, x.first, x.second};
}

MovingVector moving_direction(const Scene& scene, const PointPath& path, const Vector3& v_W,
                              const std::string& name) {
  MovingVector v{.value = v_W};
  for (const std::size_t j : path.links) {
    const std::string here = fmt::format("{}{}", name, j);
    v = with_turning(scene, j, v, here);
    v.value = scene.frames.to_parent(j, v.value, here);
    v = change_to_parent(scene, j, v, here);
  }
  return v;
}

MovingVector operator-(const MovingVector& a, const MovingVector& b) {
  return {a.value - b.value, a.first - b.first, a.second - b.second};
}

kinematics::Taylor product(const MovingVector& u, const MovingVector& w) {
  return {dot(u.value, w.value), dot(u.first, w.value) + dot(u.value, w.first),
          dot(u.second, w.value) + 2 * dot(u.first, w.first) + dot(u.value, w.second)};
}

}  // namespace jourdain::dynamics
