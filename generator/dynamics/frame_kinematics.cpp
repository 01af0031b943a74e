#include "dynamics/frame_kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dynamics/accelerations.hpp"
#include "dynamics/free_root.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using kinematics::cross;
using kinematics::dot;
using kinematics::kGround;
using kinematics::Matrix3;
using kinematics::zero_vector;
using model::Axes;
using model::KinematicQuantity;

namespace {

KinematicValues vector_of(const char* name, const Vector3& v) { return {name, 3, 0, {v[0], v[1], v[2]}}; }

KinematicValues six_of(const char* name, const Vector3& linear, const Vector3& angular) {
  return {name, 6, 0, {linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]}};
}

bool is_number(const Vector3& v) {
  const auto is_numeric = [](const Ex& e) { return GiNaC::is_a<GiNaC::numeric>(e); };
  return is_numeric(v[0]) && is_numeric(v[1]) && is_numeric(v[2]);
}

}  // namespace

FrameKinematics::FrameKinematics(const Scene& scene, const model::KinematicFunction& function)
    : scene_(scene),
      name_("f" + function.name),
      axes_(function.axes),
      pose_(frame_pose(scene, scene.mechanism.frames[function.frame->value])),
      path_(follow_point(scene, pose_.link, pose_.r_LB, kGround, name_)) {
  const std::vector<KinematicQuantity>& list = function.quantities;
  const bool jacobian = std::find(list.begin(), list.end(), KinematicQuantity::kJacobian) != list.end();
  shares_rotation_ = jacobian && axes_ != Axes::kFrame;
}

std::vector<KinematicValues> FrameKinematics::values(KinematicQuantity quantity,
                                                     const std::vector<Ex>& zdot) {
  switch (quantity) {
    case KinematicQuantity::kPose: {
      const Matrix3 R = rotation();
      KinematicValues matrix{"rotation", 3, 3, {}};
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) matrix.values.push_back(R[r][c]);
      return {vector_of("position", path_.position), matrix};
    }
    case KinematicQuantity::kVelocity: {
      const Six v = velocity();
      return {six_of("velocity", v.linear, v.angular)};
    }
    case KinematicQuantity::kAcceleration: {
      const Six a = acceleration(zdot);
      return {six_of("acceleration", a.linear, a.angular)};
    }
    case KinematicQuantity::kJacobianBias: {
      const Six a = acceleration(zdot);
      return {six_of("bias", a.linear, a.angular)};
    }
    case KinematicQuantity::kImu:
      return imu(zdot);
    case KinematicQuantity::kJacobian:
      return jacobian();
    default:
      break;
  }
  JD_CHECK(false, "quantity {} is of no frame", static_cast<int>(quantity));
  return {};
}

Vector3 FrameKinematics::bind(const std::string& what, const Vector3& v) const {
  return scene_.statements.bind(name_ + what, v);
}

Vector3 FrameKinematics::to_frame(const Vector3& v_W, const std::string& what) const {
  const Vector3 v_L = is_fixed() ? v_W : scene_.frames.to_link(pose_.link, v_W, name_ + what + "l");
  return bind(what, transpose(pose_.R_LB) * v_L);
}

/// By the rotation where that is at hand, otherwise inward from link to link.
Vector3 FrameKinematics::to_world(const Vector3& v_W, const std::string& what) {
  if (shares_rotation_) {
    const Vector3 v_B = to_frame(v_W, what);
    return bind(what + "w", rotation() * v_B);
  }
  Vector3 v = v_W;
  for (const std::size_t link : path_.links)
    v = scene_.frames.to_parent(link, v, fmt::format("{}{}i{}", name_, what, link));
  return v;
}

/// A world axis in W of each link of the way.
const std::vector<Vector3>& FrameKinematics::carried(std::size_t row) {
  if (carried_[row].empty()) {
    Vector3 axis = zero_vector();
    axis[row] = 1;
    carried_[row] = carry_outward(scene_, path_, axis, fmt::format("{}e{}", name_, row));
  }
  return carried_[row];
}

/// Columns are the frame's axes in world axes. A row that no one else needs is the product of the other two: not that
/// which costs nothing at the first joint.
Matrix3 FrameKinematics::rotation() {
  if (is_fixed()) return pose_.R_LB;
  Matrix3 R;
  const auto row = [&](std::size_t r) {
    R[r] = bind(fmt::format("R{}", r), to_frame(carried(r).front(), fmt::format("r{}", r)));
  };
  const auto turns = [&](std::size_t link) { return !scene_.tree.links[link].moves_along_z(); };
  const bool by_product =
      !shares_rotation_ && std::count_if(path_.links.begin(), path_.links.end(), turns) > 2;
  const std::size_t product = is_number(carried(0).back()) ? 1 : 0;
  for (std::size_t r = 0; r < 3; ++r)
    if (!by_product || r != product) row(r);
  if (by_product)
    R[product] = bind(fmt::format("R{}", product), cross(R[(product + 1) % 3], R[(product + 2) % 3]));
  return R;
}

const std::vector<FrameKinematics::Triad>& FrameKinematics::triads() {
  if (!triads_.empty() || is_fixed()) return triads_;
  triads_.resize(path_.links.size());
  for (std::size_t c = 0; c < 3; ++c) {
    if (axes_ != Axes::kFrame) {
      for (std::size_t k = 0; k < triads_.size(); ++k) triads_[k][c] = carried(c)[k];
      continue;
    }
    const Vector3 axis_L = transpose(pose_.R_LB)[c];
    Vector3 axis = scene_.frames.to_working(pose_.link, axis_L, fmt::format("{}a{}", name_, c));
    for (std::size_t k = 0; k < triads_.size(); ++k) {
      triads_[k][c] = axis;
      if (k + 1 < triads_.size())
        axis = scene_.frames.to_parent(path_.links[k], axis, fmt::format("{}a{}_{}", name_, c, k));
    }
  }
  return triads_;
}

Vector3 FrameKinematics::resolved(std::size_t k, const Vector3& v_W, const std::string& what) {
  const Triad& axes = triads()[k];
  return bind(what, {dot(axes[0], v_W), dot(axes[1], v_W), dot(axes[2], v_W)});
}

/// Inward: what each link adds, in its W.
FrameKinematics::Six FrameKinematics::world_velocity() {
  Six six{path_.velocity, zero_vector()};
  for (const std::size_t link : path_.links) {
    const std::string w = fmt::format("{}w{}", name_, link);
    six.angular = scene_.statements.bind(w, six.angular + scene_.relative_twist(link).angular);
    six.angular = scene_.frames.to_parent(link, six.angular, w + "p");
  }
  return six;
}

/// Outward: of the link's origin, in its W, then in the frame's axes.
FrameKinematics::Six FrameKinematics::own_velocity() {
  Vector3 v = zero_vector();
  for (std::size_t k = path_.links.size(); k-- > 0;) {
    const std::size_t link = path_.links[k], parent = scene_.tree.links[link].parent;
    const std::string name = fmt::format("{}v{}", name_, link);
    if (parent != kGround) {
      v = scene_.frames.from_parent_to_C(link, v, name + "c");
      const Vector3 w = scene_.frames.from_parent_to_C(link, scene_.omega.own[parent], name + "w");
      v = scene_.statements.bind(name + "r", v + cross(w, scene_.frames.r_CW(link)));
      v = scene_.frames.from_C_to_W(link, v, name + "t");
    }
    v = scene_.statements.bind(name, v + scene_.relative_twist(link).linear);
  }
  const Vector3& w = scene_.omega.own[pose_.link];
  v = bind("vx", v + cross(w, path_.levers.front()));
  return {to_frame(v, "v"), to_frame(w, "w")};
}

FrameKinematics::Six FrameKinematics::velocity() {
  if (is_fixed()) return {};
  if (axes_ == Axes::kFrame) return own_velocity();
  const Six six = world_velocity();
  return axes_ == Axes::kWorld ? at_world_origin(six, "vo") : six;
}

FrameKinematics::Six FrameKinematics::at_world_origin(const Six& v, const std::string& what) const {
  return {bind(what, v.linear + cross(path_.position, v.angular)), v.angular};
}

FrameKinematics::Six FrameKinematics::acceleration(const std::vector<Ex>& zdot) {
  if (is_fixed()) return {};
  const Twist at = link_accelerations(scene_, zdot, Gravity::kNone, name_)[pose_.link];
  const Vector3& w = scene_.omega.own[pose_.link];
  const Vector3& x = path_.levers.front();
  const Vector3 a = bind("a", at.linear + cross(at.angular, x) + cross(w, bind("wx", cross(w, x))));
  if (axes_ == Axes::kFrame) return {to_frame(a, "A"), to_frame(at.angular, "al")};
  Six six{to_world(a, "A"), to_world(at.angular, "al")};
  if (axes_ == Axes::kWorldAligned) return six;
  // The spatial velocity's rate: d/dt (v + p × ω) less what p × ω̇ is already.
  const Six v = world_velocity();
  const Six moved = at_world_origin(six, "ao");
  return {bind("as", moved.linear + cross(v.linear, v.angular)), moved.angular};
}

std::vector<KinematicValues> FrameKinematics::imu(const std::vector<Ex>& zdot) {
  if (is_fixed())
    return {vector_of("specific_force", bind("g", Ex(-1) * (transpose(pose_.R_LB) * scene_.tree.gravity))),
            vector_of("angular_velocity", zero_vector())};
  const Twist at = link_accelerations(scene_, zdot, Gravity::kAsAcceleration, name_ + "i")[pose_.link];
  const Vector3& w = scene_.omega.own[pose_.link];
  const Vector3& x = path_.levers.front();
  Vector3 a = bind("ai", at.linear + cross(at.angular, x) + cross(w, bind("wxi", cross(w, x))));
  return {vector_of("specific_force", to_frame(a, "F")), vector_of("angular_velocity", to_frame(w, "W"))};
}

std::vector<KinematicValues> FrameKinematics::jacobian() {
  const std::size_t nz = scene_.layout.velocity_count();
  KinematicValues J{"J", 6, static_cast<int>(nz), std::vector<Ex>(6 * nz, 0)};
  Six drift;
  for (std::size_t k = 0; k < path_.links.size(); ++k) {
    const std::size_t j = path_.links[k];
    const kinematics::Link& link = scene_.tree.links[j];
    for (std::size_t c = 0; c < scene_.columns[j].size(); ++c) {
      const Column& column = scene_.columns[j][c];
      const std::string what = fmt::format("J{}_{}", j, c);
      Vector3 linear_W = column.twist.linear;
      if (is_free(link) && c < 3)
        linear_W = scene_.frames.from_parent(j, linear_W, what + "f");  // z has it in the inertial frame
      else
        linear_W = linear_W + cross(column.twist.angular, path_.levers[k] + link.shift);
      Six six{resolved(k, bind(what + "W", linear_W), what + "t"),
              resolved(k, column.twist.angular, what + "r")};
      if (is_free(link) && c < 3 && axes_ != Axes::kFrame) six.linear = column.twist.linear;
      if (axes_ == Axes::kWorld) six = at_world_origin(six, what + "o");
      if (!column.entry) {
        const Ex rate = kinematics::coordinate_motion(link, scene_.states[j]).first;
        drift.linear = bind(what + "dt", drift.linear + rate * six.linear);
        drift.angular = bind(what + "dr", drift.angular + rate * six.angular);
        continue;
      }
      for (std::size_t r = 0; r < 3; ++r) {
        J.values[r * nz + *column.entry] = six.linear[r];
        J.values[(3 + r) * nz + *column.entry] = six.angular[r];
      }
    }
  }
  std::vector<KinematicValues> list;
  if (nz > 0) list.push_back(J);
  list.push_back(six_of("drift", drift.linear, drift.angular));
  return list;
}

}  // namespace jourdain::dynamics
