// Implementation of Reference: each joint's own kinematics. For minimal.cpp only.
#pragma once

#include "model/motion_sources.hpp"
#include "reference/frame_motion.hpp"
#include "support/check.hpp"

namespace jourdain::reference {

using model::JointType;

template <class Scalar>
Vector3<Scalar> unit(const std::array<double, 3>& direction) {
  return Vector3<Scalar>(Scalar(direction[0]), Scalar(direction[1]), Scalar(direction[2])).stableNormalized();
}

/// The polynomial without division: of a quaternion near unit length.
template <class Scalar>
Matrix3<Scalar> quaternion_rotation(Scalar w, Scalar x, Scalar y, Scalar z) {
  Matrix3<Scalar> R;
  R << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return R;
}

template <class Scalar>
Eigen::Index Reference<Scalar>::column_count() const {
  return Eigen::Index(layout_.velocity_count() + prescribed_.size());
}

template <class Scalar>
Eigen::Index Reference<Scalar>::column_of(std::size_t joint, std::size_t coordinate) const {
  if (const auto entry = layout_.joints[joint].velocity[coordinate]) return Eigen::Index(*entry);
  for (std::size_t i = 0; i < prescribed_.size(); ++i)
    if (prescribed_[i] == std::pair(joint, coordinate)) return Eigen::Index(layout_.velocity_count() + i);
  JD_CHECK(false, "joint {} has no coordinate {}", joint, coordinate);
  return 0;
}

template <class Scalar>
Taylor<Scalar> Reference<Scalar>::taylor(const model::Expression& expression, Scalar variable) const {
  std::vector<Taylor<Scalar>> parameters;
  for (const Scalar& p : parameters_) parameters.push_back({p, 0, 0});
  return expression.evaluate<Taylor<Scalar>>(
      parameters,
      [](double v) {
        return Taylor<Scalar>{Scalar(v), 0, 0};
      },
      [&](const model::Variable&) {
        return Taylor<Scalar>{variable, 1, 0};
      });
}

/// Value and rate of a scalar coordinate, and the acceleration of a prescribed one.
template <class Scalar>
Taylor<Scalar> Reference<Scalar>::coordinate(std::size_t joint, std::size_t which,
                                             const State<Scalar>& state) const {
  const model::Coordinate& coordinate = mechanism_.joints[joint].coordinates[which];
  if (coordinate.motion)
    return model::motion_taylor<Scalar>(
        *coordinate.motion, mechanism_.states, parameters_, [&](const model::Variable& v) -> Scalar {
          using Kind = model::Variable::Kind;
          if (v.kind == Kind::kTime) return state.t;
          if (v.kind == Kind::kState) return state.z[Eigen::Index(layout_.first_state() + v.index)];
          JD_CHECK(v.kind == Kind::kInput && Eigen::Index(v.index) < state.u.size(),
                   "a motion depends on variable kind {}", int(v.kind));
          return state.u[Eigen::Index(v.index)];
        });
  const model::JointEntries& entries = layout_.joints[joint];
  return {state.y[Eigen::Index(*entries.position[which])], state.z[Eigen::Index(*entries.velocity[which])],
          0};
}

template <class Scalar>
typename Reference<Scalar>::FrameMotion Reference<Scalar>::world_motion() const {
  const Jacobian<Scalar> J = Jacobian<Scalar>::Zero(3, column_count());
  const Vector3<Scalar> zero = Vector3<Scalar>::Zero();
  return {Matrix3<Scalar>::Identity(), zero, J, J, zero, zero, zero, zero, J, J, zero, zero, zero};
}

template <class Scalar>
typename Reference<Scalar>::FrameMotion Reference<Scalar>::child_motion(const FrameMotion& parent,
                                                                        std::size_t index,
                                                                        const State<Scalar>& state) const {
  const model::Joint& joint = mechanism_.joints[index];
  FrameMotion child = parent;
  child.shift(parent.R * vector_value(joint.placement.position, std::span<const Scalar>(parameters_)));
  child.R = parent.R *
            rotation_value(joint.placement.rotation, std::span<const Scalar>(parameters_), mechanism_.snap);
  const Vector3<Scalar> zero = Vector3<Scalar>::Zero();
  const auto turn = [&](std::size_t which, const Vector3<Scalar>& axis) {
    const Taylor<Scalar> q = coordinate(index, which, state);
    child.turn(child.R * axis, q.first, column_of(index, which));
    child.R = child.R * rotation_about<Scalar>(axis, q.value);
  };
  const auto slide = [&](std::size_t which, const Vector3<Scalar>& axis, Scalar factor) {
    const Taylor<Scalar> q = coordinate(index, which, state);
    const Vector3<Scalar> direction = child.R * axis * factor;
    child.slide(direction * q.value, direction, zero, q.first, column_of(index, which));
  };
  const Vector3<Scalar> axis = unit<Scalar>(joint.axis);
  switch (joint.type) {
    case JointType::kFixed:
      break;
    case JointType::kRevolute:
      turn(0, axis);
      break;
    case JointType::kPrismatic:
      slide(0, axis, 1);
      break;
    case JointType::kScrew:
      slide(0, axis, value(joint.pitch));
      turn(0, axis);
      break;
    case JointType::kCylindrical:
      slide(1, axis, 1);
      turn(0, axis);
      break;
    case JointType::kUniversal:
      turn(0, axis);
      turn(1, unit<Scalar>(joint.second_axis));
      break;
    case JointType::kPlanar: {
      const auto directions = model::slide_directions(joint.axis);
      slide(0, unit<Scalar>(directions[0]), 1);
      slide(1, unit<Scalar>(directions[1]), 1);
      turn(2, axis);
      break;
    }
    case JointType::kPoint:
      for (std::size_t k = 0; k < 3; ++k) slide(k, Vector3<Scalar>::Unit(Eigen::Index(k)), 1);
      break;
    case JointType::kCurve: {
      const Taylor<Scalar> q = coordinate(index, 0, state);
      Vector3<Scalar> place, slope, curvature;
      for (int k = 0; k < 3; ++k) {
        const Taylor<Scalar> c = taylor(joint.curve[std::size_t(k)], q.value);
        place[k] = c.value;
        slope[k] = c.first;
        curvature[k] = c.second;
      }
      child.slide(child.R * place, child.R * slope, child.R * curvature, q.first, column_of(index, 0));
      break;
    }
    case JointType::kGimbal:
      for (std::size_t k = 0; k < 3; ++k) turn(k, Vector3<Scalar>::Unit(Eigen::Index(joint.sequence[k])));
      break;
    case JointType::kSpherical:
    case JointType::kFree:
      turn_freely(child, index, state);
      break;
  }
  return child;
}

template <class Scalar>
void Reference<Scalar>::turn_freely(FrameMotion& child, std::size_t index, const State<Scalar>& state) const {
  const model::JointEntries& entries = layout_.joints[index];
  auto y = Eigen::Index(entries.first_position), z = Eigen::Index(entries.first_velocity);
  if (mechanism_.joints[index].type == JointType::kFree) {
    child.p = state.y.segment(y, 3);
    child.p_scale = child.p.cwiseAbs();
    for (Eigen::Index k = 0; k < 3; ++k) child.J_t(k, z + k) = child.J_t_scale(k, z + k) = 1;
    y += 3;
    z += 3;
  }
  child.R = child.R * quaternion_rotation<Scalar>(state.y[y], state.y[y + 1], state.y[y + 2], state.y[y + 3]);
  // The relative angular velocity turns with the child: its own components add nothing to zeta_bar beyond ω × w.
  const Vector3<Scalar> before = child.omega, before_scale = child.omega_scale;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vector3<Scalar> axis = child.R.col(k), w = axis * state.z[z + k];
    child.J_r.col(z + k) += axis;
    child.J_r_scale.col(z + k) += axis.cwiseAbs();
    child.zeta_bar += before.cross(w);
    child.zeta_bar_scale += cross_scale<Scalar>(before_scale, w);
    child.omega += w;
    child.omega_scale += w.cwiseAbs();
  }
}

template <class Scalar>
std::vector<typename Reference<Scalar>::FrameMotion> Reference<Scalar>::body_frames(
    const State<Scalar>& state) const {
  JD_CHECK(state.y.size() == Eigen::Index(position_count()), "{} positions for {}", state.y.size(),
           position_count());
  JD_CHECK(state.z.size() == Eigen::Index(coordinate_count()), "{} velocities for {}", state.z.size(),
           coordinate_count());
  const FrameMotion world = world_motion();
  std::vector<FrameMotion> frames(bodies_.size(), world);
  for (const model::JointIndex index : order_) {
    const model::Joint& joint = mechanism_.joints[index.value];
    frames[joint.child.value] =
        child_motion(joint.parent ? frames[joint.parent->value] : world, index.value, state);
  }
  return frames;
}

template <class Scalar>
typename Reference<Scalar>::FrameMotion Reference<Scalar>::placed(const std::vector<FrameMotion>& bodies,
                                                                  const model::Frame& frame) const {
  FrameMotion at = frame.body ? bodies[frame.body->value] : world_motion();
  at.shift(at.R * vector_value(frame.placement.position, std::span<const Scalar>(parameters_)));
  at.R =
      at.R * rotation_value(frame.placement.rotation, std::span<const Scalar>(parameters_), mechanism_.snap);
  return at;
}

/// The columns of prescribed velocities become v̄, ω̄ and parts of ā, ζ̄; rotations in components of the frame.
template <class Scalar>
BodyMotion<Scalar> Reference<Scalar>::seen(const FrameMotion& frame, const State<Scalar>& state) const {
  const auto nz = Eigen::Index(layout_.velocity_count());
  VectorX<Scalar> rate(column_count() - nz), acceleration(column_count() - nz);
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    const Taylor<Scalar> q = coordinate(prescribed_[i].first, prescribed_[i].second, state);
    rate[Eigen::Index(i)] = q.first;
    acceleration[Eigen::Index(i)] = q.second;
  }
  const Matrix3<Scalar> R = frame.R.transpose(), R_s = R.cwiseAbs();
  const auto own = [nz](const Jacobian<Scalar>& J) { return J.leftCols(nz); };
  const auto rest = [&](const Jacobian<Scalar>& J) { return J.rightCols(J.cols() - nz); };
  const VectorX<Scalar> rate_s = rate.cwiseAbs(), acceleration_s = acceleration.cwiseAbs();
  return {.R_WB = frame.R,
          .p_WC = frame.p,
          .J_t = own(frame.J_t),
          .J_r = R * own(frame.J_r),
          .v_bar = rest(frame.J_t) * rate,
          .a_bar = frame.a_bar + rest(frame.J_t) * acceleration,
          .omega_bar = R * (rest(frame.J_r) * rate),
          .zeta_bar = R * (frame.zeta_bar + rest(frame.J_r) * acceleration),
          .v = own(frame.J_t) * state.z + rest(frame.J_t) * rate,
          .omega = R * frame.omega,
          .J_t_scale = own(frame.J_t_scale),
          .J_r_scale = R_s * own(frame.J_r_scale),
          .p_scale = frame.p_scale,
          .v_scale = own(frame.J_t_scale) * state.z.cwiseAbs() + rest(frame.J_t_scale) * rate_s,
          .a_bar_scale = frame.a_bar_scale + rest(frame.J_t_scale) * acceleration_s,
          .omega_scale = R_s * frame.omega_scale,
          .zeta_bar_scale = R_s * (frame.zeta_bar_scale + rest(frame.J_r_scale) * acceleration_s)};
}

template <class Scalar>
std::vector<BodyMotion<Scalar>> Reference<Scalar>::motion(const State<Scalar>& state) const {
  const std::vector<FrameMotion> frames = body_frames(state);
  std::vector<BodyMotion<Scalar>> motions;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    FrameMotion center = frames[i];
    center.shift(center.R * bodies_[i].p_BC);
    motions.push_back(seen(center, state));
  }
  return motions;
}

template <class Scalar>
std::vector<BodyMotion<Scalar>> Reference<Scalar>::frame_motion(const State<Scalar>& state) const {
  const std::vector<FrameMotion> frames = body_frames(state);
  std::vector<BodyMotion<Scalar>> motions;
  for (const model::Frame& frame : mechanism_.frames) motions.push_back(seen(placed(frames, frame), state));
  return motions;
}

template <class Scalar>
VectorX<Scalar> Reference<Scalar>::position_rate(const State<Scalar>& state) const {
  VectorX<Scalar> rate(state.y.size());
  for (const model::JointIndex index : order_) {
    const model::JointEntries& entries = layout_.joints[index.value];
    for (std::size_t c = 0; c < entries.position.size(); ++c)
      if (entries.position[c])
        rate[Eigen::Index(*entries.position[c])] = state.z[Eigen::Index(*entries.velocity[c])];
    const JointType type = mechanism_.joints[index.value].type;
    if (type != JointType::kFree && type != JointType::kSpherical) continue;
    auto y = Eigen::Index(entries.first_position), z = Eigen::Index(entries.first_velocity);
    if (type == JointType::kFree) {
      rate.segment(y, 3) = state.z.segment(z, 3);
      y += 3;
      z += 3;
    }
    const Scalar w = state.y[y];
    const Vector3<Scalar> v = state.y.segment(y + 1, 3), omega = state.z.segment(z, 3);
    rate[y] = -v.dot(omega) / 2;
    rate.segment(y + 1, 3) = (w * omega + v.cross(omega)) / 2;
  }
  return rate;
}

}  // namespace jourdain::reference
