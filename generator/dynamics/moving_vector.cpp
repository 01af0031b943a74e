#include "dynamics/moving_vector.hpp"

#include <fmt/format.h>

#include "kinematics/numbers.hpp"

namespace jourdain::dynamics {

using kinematics::Link;
using kinematics::LinkKind;

InwardPath::InwardPath(Scene& scene, std::size_t link, std::size_t ancestor) : scene_(scene) {
  for (std::size_t j = link; j != ancestor; j = scene.tree.links[j].parent) links_.push_back(j);
}

/// With w the relative angular velocity and α its prescribed change: v̇ + w × v, v̈ + α × v + w × (w × v + 2 v̇).
void InwardPath::add_turning(std::size_t j, const Vector3& value, MovingVector& moving,
                             const std::string& name) const {
  const Link& link = scene_.tree.links[j];
  if (!link.turns_about_z() && !link.has_quaternion()) return;
  const Vector3 w = scene_.relative_twist(j).angular;
  const Vector3 alpha = {0, 0, link.turns_about_z() ? scene_.states[j].acceleration : kinematics::Ex(0)};
  const Vector3 turned = scene_.statements.bind(name + "t", cross(w, value));
  const Vector3 both = scene_.statements.bind(name + "b", turned + Ex(2) * moving.first);
  moving.second = scene_.statements.bind(name + "a", moving.second + cross(alpha, value) + cross(w, both));
  moving.first = scene_.statements.bind(name + "v", moving.first + turned);
}

void InwardPath::add_sliding(std::size_t j, MovingVector& moving, const std::string& name) const {
  const Link& link = scene_.tree.links[j];
  const kinematics::LinkState& state = scene_.states[j];
  const Twist twist = scene_.relative_twist(j);
  moving.first = scene_.statements.bind(name + "vl", moving.first + twist.linear);
  if (link.kind == LinkKind::kFree) {
    const Vector3 shifted = scene_.statements.bind(name + "s", cross(state.spin, link.shift));
    moving.second = scene_.statements.bind(name + "al", moving.second + cross(state.spin, shifted));
    return;
  }
  const Ex square = scene_.statements.bind(name + "zz", state.rate * state.rate);
  moving.second =
      scene_.statements.bind(name + "al", moving.second + state.acceleration * scene_.frames.direction(j) +
                                              square * scene_.frames.curvature(j));
}

MovingVector InwardPath::point(const std::vector<Vector3>& levers, const Vector3& position,
                               const std::string& name) const {
  MovingVector moving;
  for (std::size_t k = 0; k < links_.size(); ++k) {
    const std::string here = fmt::format("{}{}", name, links_[k]);
    add_turning(links_[k], levers[k], moving, here);
    add_sliding(links_[k], moving, here);
    moving.first = scene_.frames.to_parent(links_[k], moving.first, here + "vp");
    moving.second = scene_.frames.to_parent(links_[k], moving.second, here + "ap");
  }
  moving.value = position;
  return moving;
}

MovingVector InwardPath::direction(Vector3 v, const std::string& name) const {
  MovingVector moving;
  for (const std::size_t j : links_) {
    const std::string here = fmt::format("{}{}", name, j);
    add_turning(j, v, moving, here);
    v = scene_.frames.to_parent(j, v, here);
    moving.first = scene_.frames.to_parent(j, moving.first, here + "vp");
    moving.second = scene_.frames.to_parent(j, moving.second, here + "ap");
  }
  moving.value = v;
  return moving;
}

MovingVector operator-(const MovingVector& a, const MovingVector& b) {
  return {a.value - b.value, a.first - b.first, a.second - b.second};
}

kinematics::Taylor product(const MovingVector& u, const MovingVector& w) {
  return {dot(u.value, w.value), dot(u.first, w.value) + dot(u.value, w.first),
          dot(u.second, w.value) + 2 * dot(u.first, w.first) + dot(u.value, w.second)};
}

}  // namespace jourdain::dynamics
