#include "dynamics/centroidal.hpp"

#include <fmt/format.h>

#include <utility>

#include "dynamics/accelerations.hpp"
#include "dynamics/free_root.hpp"
#include "dynamics/wrenches.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using kinematics::cross;
using kinematics::dot;
using kinematics::kGround;
using kinematics::zero_vector;
using model::KinematicQuantity;

namespace {

KinematicValues three(const char* name, const Vector3& v) { return {name, 3, 0, {v[0], v[1], v[2]}}; }

KinematicValues six(const char* name, const Wrench& w) {
  return {name, 6, 0, {w.force[0], w.force[1], w.force[2], w.moment[0], w.moment[1], w.moment[2]}};
}

}  // namespace

Centroidal::Centroidal(const Scene& scene, std::string name) : scene_(scene), name_(std::move(name)) {}

std::vector<KinematicValues> Centroidal::values(KinematicQuantity quantity, const std::vector<Ex>& zdot) {
  switch (quantity) {
    case KinematicQuantity::kCenterOfMass:
      return {three("center_of_mass", center_of_mass())};
    case KinematicQuantity::kCenterOfMassJacobian:
      return columns("J_com", "drift_com", false);
    case KinematicQuantity::kCenterOfMassBias:
      return {three("bias_com", bind("cb", per_mass(rate(zdot).force)))};
    case KinematicQuantity::kMomentum:
      return {six("momentum", momentum())};
    case KinematicQuantity::kCentroidalMomentumMatrix:
      return columns("A", "drift_momentum", true);
    case KinematicQuantity::kCentroidalMomentumBias:
      return {six("bias_momentum", rate(zdot))};
    default:
      break;
  }
  JD_CHECK(false, "quantity {} is not of all bodies", static_cast<int>(quantity));
  return {};
}

Vector3 Centroidal::bind(const std::string& what, const Vector3& v) const {
  return scene_.statements.bind(name_ + what, v);
}

std::vector<std::size_t> Centroidal::roots() const {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < scene_.link_count(); ++i)
    if (scene_.tree.links[i].parent == kGround) list.push_back(i);
  return list;
}

/// Then lengths from its origin do, and positions in the world, which may be large, do not come in.
bool Centroidal::hangs_on_one_free_link() const {
  const std::vector<std::size_t> list = roots();
  return list.size() == 1 && is_free(scene_.tree.links[list.front()]) && scene_.tree.ground.mass.is_zero();
}

Ex Centroidal::mass() {
  Ex sum = scene_.tree.ground.mass;
  for (const std::size_t root : roots()) sum += scene_.composites[root].moments.mass;
  return scene_.statements.bind(name_ + "m", sum);
}

Vector3 Centroidal::per_mass(const Vector3& v) { return (1 / mass()) * v; }

Vector3 Centroidal::center_of_mass() {
  if (center_) return *center_;
  Vector3 first = scene_.tree.ground.first;
  if (hangs_on_one_free_link()) first = zero_vector();
  for (const std::size_t root : roots()) {
    const kinematics::MassMoments& moments = scene_.composites[root].moments;
    const Vector3 h = scene_.frames.to_parent(root, moments.first, fmt::format("{}h{}", name_, root));
    first = first + h;
    if (!hangs_on_one_free_link()) first = first + moments.mass * scene_.frames.r_CW(root);
  }
  Vector3 center = per_mass(bind("h", first));
  if (hangs_on_one_free_link()) center = center + scene_.frames.r_CW(roots().front());
  center_ = bind("c", center);
  return *center_;
}

Vector3 Centroidal::arm(std::size_t root) {
  if (hangs_on_one_free_link()) return bind("d", (-1 / mass()) * scene_.composites[root].moments.first);
  const Vector3 outward = scene_.frames.r_CW(root) - center_of_mass();
  return scene_.frames.from_parent(root, outward, fmt::format("{}d{}", name_, root));
}

/// In world axes, about the centre of mass; given in W of a root link, about its origin.
Wrench Centroidal::about_center(std::size_t root, const Wrench& at_root, const std::string& what) {
  const Vector3 moment = bind(what + "n", at_root.moment + cross(arm(root), at_root.force));
  return {scene_.frames.to_parent(root, at_root.force, name_ + what + "F"),
          scene_.frames.to_parent(root, moment, name_ + what + "N")};
}

/// Inertia forces of what each joint adds to the motion of everything outward of it.
Wrench Centroidal::rate(const std::vector<Ex>& zdot) {
  const JointAccelerations motion = joint_accelerations(scene_, zdot, Gravity::kNone, name_);
  const std::vector<Wrench> own = derive_relative_inertia_forces(scene_, motion, name_ + "i");
  const std::vector<Wrench> totals = accumulate_wrenches(scene_, own, name_ + "s");
  Wrench sum;
  for (const std::size_t root : roots())
    sum = bound(scene_, name_ + "r", sum + about_center(root, totals[root], fmt::format("r{}", root)));
  return sum;
}

/// What each joint adds, on everything outward of it.
Wrench Centroidal::momentum() {
  std::vector<Wrench> own;
  for (std::size_t i = 0; i < scene_.link_count(); ++i)
    own.push_back(bound(scene_, fmt::format("{}p{}", name_, i),
                        dynamics::momentum(scene_.composites[i], scene_.relative_twist(i))));
  const std::vector<Wrench> totals = accumulate_wrenches(scene_, own, name_ + "P");
  Wrench sum;
  for (const std::size_t root : roots())
    sum = bound(scene_, name_ + "t", sum + about_center(root, totals[root], fmt::format("t{}", root)));
  return sum;
}

/// Outward: world axes in W of each link, and its origin from the centre of mass.
void Centroidal::place_links() {
  if (!places_.empty()) return;
  for (std::size_t i = 0; i < scene_.link_count(); ++i) {
    const std::size_t parent = scene_.tree.links[i].parent;
    const std::string name = fmt::format("{}l{}", name_, i);
    Place place;
    Vector3 step;
    for (std::size_t r = 0; r < 3; ++r) {
      Vector3 axis = zero_vector();
      axis[r] = 1;
      if (parent != kGround) axis = places_[parent].axes[r];
      place.axes[r] = scene_.frames.from_parent(i, axis, fmt::format("{}e{}", name, r));
      if (parent != kGround)
        step[r] = dot(scene_.frames.from_parent_to_C(i, axis, fmt::format("{}c{}", name, r)),
                      scene_.frames.r_CW(i));
    }
    if (parent != kGround)
      place.arm = scene_.statements.bind(name + "d", places_[parent].arm + step);
    else if (hangs_on_one_free_link())
      place.arm = in_world(place, arm(i), name + "d");
    else
      place.arm = scene_.statements.bind(name + "d", scene_.frames.r_CW(i) - center_of_mass());
    places_.push_back(place);
  }
}

Vector3 Centroidal::in_world(const Place& place, const Vector3& v_W, const std::string& name) const {
  const Vector3 v = {dot(place.axes[0], v_W), dot(place.axes[1], v_W), dot(place.axes[2], v_W)};
  return scene_.statements.bind(name, v);
}

/// Momentum per unit of a column, in world axes, about the centre of mass.
Wrench Centroidal::column_momentum(std::size_t i, std::size_t c) {
  const kinematics::Link& link = scene_.tree.links[i];
  const CompositeBody& body = scene_.composites[i];
  const std::string name = fmt::format("{}A{}_{}", name_, i, c);
  const Place& place = places_[i];
  Twist twist = scene_.columns[i][c].twist;
  if (is_free(link) && c < 3) {  // z has it in the inertial frame
    if (hangs_on_one_free_link()) return {body.moments.mass * twist.linear, zero_vector()};
    const Vector3 h = body.moments.mass * place.arm + in_world(place, body.moments.first, name + "h");
    return bound(scene_, name, {body.moments.mass * twist.linear, cross(h, twist.linear)});
  }
  twist.linear = twist.linear + cross(twist.angular, link.shift);
  const Wrench own = bound(scene_, name + "m", dynamics::momentum(body, twist));
  const Vector3 force = in_world(place, own.force, name + "f");
  return {force, scene_.statements.bind(name + "n",
                                        in_world(place, own.moment, name + "w") + cross(place.arm, force))};
}

std::vector<KinematicValues> Centroidal::columns(const char* matrix, const char* drift, bool of_momentum) {
  place_links();
  const std::size_t nz = scene_.layout.velocity_count();
  const int rows = of_momentum ? 6 : 3;
  KinematicValues A{matrix, rows, static_cast<int>(nz), std::vector<Ex>(static_cast<std::size_t>(rows) * nz)};
  Wrench driven;
  const Ex per_mass = of_momentum ? Ex(1) : 1 / mass();
  for (std::size_t i = 0; i < scene_.link_count(); ++i)
    for (std::size_t c = 0; c < scene_.columns[i].size(); ++c) {
      const std::string what = fmt::format("{}C{}_{}", name_, i, c);
      const Wrench total = bound(scene_, what, per_mass * column_momentum(i, c));
      const Column& column = scene_.columns[i][c];
      if (!column.entry) {
        const Ex rate = kinematics::coordinate_motion(scene_.tree.links[i], scene_.states[i]).first;
        driven = bound(scene_, what + "d", driven + rate * total);
        continue;
      }
      for (std::size_t r = 0; r < 3; ++r) {
        A.values[r * nz + *column.entry] = total.force[r];
        if (of_momentum) A.values[(3 + r) * nz + *column.entry] = total.moment[r];
      }
    }
  std::vector<KinematicValues> list;
  if (nz > 0) list.push_back(A);
  list.push_back(of_momentum ? six(drift, driven) : three(drift, driven.force));
  return list;
}

}  // namespace jourdain::dynamics
