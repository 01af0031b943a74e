#include "properties/loop_ends.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "properties/arithmetic.hpp"
#include "reference/minimal.hpp"

namespace jourdain::tests {

namespace {

using model::Expression;
using model::LoopType;
using model::Variable;
using std::numbers::pi;
using Long = long double;

constexpr Long kNoise = 1e-15L;  // what rounding leaves of a length or an angle that is zero

double clean(Long value) { return std::fabs(value) < kNoise ? 0.0 : double(value); }

reference::Vector3<Long> vector(const std::array<double, 3>& v) {
  return reference::Vector3<double>(v.data()).cast<Long>();
}
std::array<double, 3> cleaned(const reference::Vector3<Long>& v) {
  return {clean(v.x()), clean(v.y()), clean(v.z())};
}

/// Roll, pitch and yaw of R = Rz(yaw) Ry(pitch) Rx(roll).
model::Vector3 angles(const reference::Matrix3<Long>& R) {
  return {clean(std::atan2(R(2, 1), R(2, 2))), clean(std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0)))),
          clean(std::atan2(R(1, 0), R(0, 0)))};
}

/// Whether a loop joint of this type turns about its axis, in a plane about the normal.
bool is_hinge(LoopType type) {
  return type == LoopType::kBall || type == LoopType::kRevolute || type == LoopType::kUniversal ||
         type == LoopType::kPlanarPin;
}

}  // namespace

Expression departure(Random& random) {
  const Expression t = variable(Variable::Kind::kTime);
  const double size = random.uniform(-0.1, 0.1);
  return Expression(size) * (Expression(1.0) - cosine(Expression(random.uniform(1, 3)) * t));
}

LoopEnds::Pose LoopEnds::pose(const model::Frame& frame) const {
  model::Mechanism alone = mechanism_;
  alone.frames = {frame};
  const reference::Reference<Long> reference(alone);
  const auto motion = reference.frame_motion(reference.initial_state()).front();
  return {motion.R_WB, motion.p_WC};
}

LoopEnds::Pose LoopEnds::pose_of_body(std::optional<model::BodyIndex> body) const {
  model::Frame frame;
  frame.body = body;
  return pose(frame);
}

model::FrameIndex LoopEnds::add(const model::Frame& frame) {
  mechanism_.frames.push_back(frame);
  mechanism_.frames.back().name = fmt::format("frame{}", mechanism_.frames.size() - 1);
  return model::FrameIndex(mechanism_.frames.size() - 1);
}

model::Frame LoopEnds::random_frame(std::optional<model::BodyIndex> body) {
  model::Frame frame;
  frame.body = body;
  const Vector place(random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5));
  model::Vector3& position = frame.placement.position;
  model::Vector3& rpy = frame.placement.rotation.rpy;
  position = {double(place.x()), double(place.y()), tilt_ ? 0.0 : double(place.z())};
  rpy = tilt_ ? model::Vector3{0.0, 0.0, random_.uniform(-pi, pi)}
              : model::Vector3{random_.uniform(-pi, pi), random_.uniform(-1, 1), random_.uniform(-pi, pi)};
  if (!tilt_ || body) return frame;
  rpy = {(*tilt_)[0], (*tilt_)[1], (*tilt_)[2]};
  const Matrix R = reference::rotation_value<Long>(frame.placement.rotation, {}, true);
  const Vector in_plane = R * Vector(place.x(), place.y(), 0);
  for (std::size_t i = 0; i < 3; ++i) position[i] = double(in_plane[Eigen::Index(i)]);
  return frame;
}

/// A direction in a frame; in a plane the normal or one along it.
std::array<double, 3> LoopEnds::direction(bool in_plane) {
  if (!tilt_) {
    if (random_.chance(0.3)) return {0, 0, 1};
    return {random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(0.2, 1)};
  }
  const double angle = random_.uniform(-pi, pi);
  if (in_plane) return {std::cos(angle), std::sin(angle), 0};
  return {0, 0, 1};
}

void LoopEnds::choose_axes(model::Loop& loop, const Pose& carrier) {
  loop.axis = direction(!is_hinge(loop.type));
  loop.to_axis = loop.axis;
  if (loop.type == LoopType::kUniversal) {
    const Vector across = vector(loop.axis).unitOrthogonal();
    loop.to_axis = cleaned(across);
  }
  if (loop.type != LoopType::kPlanarPin || !tilt_) return;
  const model::Rotation plane{{(*tilt_)[0], (*tilt_)[1], (*tilt_)[2]}};
  loop.axis = cleaned(carrier.R.transpose() * reference::rotation_value<Long>(plane, {}, true).col(2));
}

/// From the first end to the second, inertial components; sets the length of a rod.
LoopEnds::Vector LoopEnds::offset(model::Loop& loop, const Pose& from, const Pose& carrier) {
  const Vector n = from.R * vector(loop.axis).normalized();
  const Long step = random_.uniform(-0.3, 0.3);
  switch (loop.type) {
    case LoopType::kBall:
    case LoopType::kRevolute:
    case LoopType::kUniversal:
    case LoopType::kResidual:
      break;
    case LoopType::kPrismatic:
    case LoopType::kCylindrical:
    case LoopType::kPointOnLine:
      return step * n;
    case LoopType::kPlanarPin:
      return tilt_ ? Vector::Zero() : Vector(step * (carrier.R * vector(loop.axis)).normalized());
    case LoopType::kPointInPlane:
      return step * (tilt_ ? n.cross(from.R.col(2)) : n.unitOrthogonal());
    case LoopType::kRod: {
      Vector rod(random_.uniform(0.2, 0.6), random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5));
      if (tilt_) rod.z() = 0;
      loop.length = double(rod.norm());
      if (random_.chance(0.5)) loop.length = loop.length + departure(random_);
      return from.R * rod;
    }
    case LoopType::kKnifeEdge:
      return from.R * Vector(random_.uniform(-0.3, 0.3), step, 0);
    case LoopType::kRollingBall:
      loop.length = random_.uniform(0.1, 0.4);
      return step * n.unitOrthogonal() + Long(loop.length.constant()) * n;
    case LoopType::kRollingWheel:
    case LoopType::kRollingEllipsoid:
    case LoopType::kVelocity:
      break;
  }
  return Vector::Zero();
}

/// The centre of a wheel or an ellipsoid whose frame is turned by R, from a point of the plane; sets sizes and what a
/// wheel spins about.
LoopEnds::Vector LoopEnds::standing(model::Loop& loop, const Pose& from, const Matrix& R) {
  const Vector n = from.R * vector(loop.axis).normalized(), u = n.unitOrthogonal();
  const Long lean = random_.uniform(-1, 1), step = random_.uniform(-0.3, 0.3);
  if (loop.type == LoopType::kRollingEllipsoid) {
    Vector radii;
    for (Long& radius : radii) radius = random_.uniform(0.1, 0.4);
    for (std::size_t k = 0; k < 3; ++k) loop.radii[k] = double(radii[Eigen::Index(k)]);
    return step * u + (R.transpose() * n).cwiseProduct(radii).norm() * n;
  }
  loop.length = random_.uniform(0.1, 0.4);
  loop.to_axis = cleaned(R.transpose() * (std::cos(lean) * u + std::sin(lean) * n));
  return step * u.cross(n) + Long(loop.length.constant()) * std::cos(lean) * n;
}

/// Orientation of the second end.
LoopEnds::Matrix LoopEnds::turned(const model::Loop& loop, const Matrix& R_WF) {
  const Long angle = random_.uniform(-pi, pi);
  const Matrix R_WT = R_WF * reference::rotation_about<Long>(vector(loop.axis).normalized(), angle);
  switch (loop.type) {
    case LoopType::kPrismatic:
      return R_WF;
    case LoopType::kUniversal:
      if (tilt_) return R_WT;
      return R_WT * reference::rotation_about<Long>(vector(loop.to_axis).normalized(),
                                                    Long(random_.uniform(-pi, pi)));
    case LoopType::kRevolute:
    case LoopType::kCylindrical:
      return R_WT;
    case LoopType::kBall:
    case LoopType::kPlanarPin:
    case LoopType::kPointInPlane:
    case LoopType::kPointOnLine:
    case LoopType::kRod:
    case LoopType::kResidual:
    case LoopType::kVelocity:
    case LoopType::kKnifeEdge:
    case LoopType::kRollingWheel:
    case LoopType::kRollingBall:
    case LoopType::kRollingEllipsoid:
      break;
  }
  return tilt_ ? R_WF : R_WT;
}

void LoopEnds::close(LoopType type) {
  model::Loop loop;
  loop.name = fmt::format("loop{}", mechanism_.loops.size());
  loop.type = type;
  if (type == LoopType::kResidual) {
    add_residual(loop);
    return;
  }
  const std::size_t count = mechanism_.bodies.size(), to_body = random_.below(count);
  std::optional<model::BodyIndex> from_body;
  if (random_.chance(0.6)) from_body = model::BodyIndex((to_body + 1 + random_.below(count - 1)) % count);
  const model::Frame from_frame = random_frame(from_body);
  const auto carrier = model::carrier(mechanism_, from_body, model::BodyIndex(to_body));
  const Pose from = pose(from_frame), body = pose_of_body(model::BodyIndex(to_body)),
             held = pose_of_body(carrier);
  choose_axes(loop, held);

  model::Frame to_frame;
  to_frame.body = model::BodyIndex(to_body);
  const bool stands = type == LoopType::kRollingWheel || type == LoopType::kRollingEllipsoid;
  Vector way = stands ? Vector(Vector::Zero()) : offset(loop, from, held);
  const Matrix R_WT = turned(loop, from.R);
  if (stands) way = standing(loop, from, R_WT);
  const Vector place = body.R.transpose() * (from.p + way - body.p);
  for (std::size_t i = 0; i < 3; ++i) to_frame.placement.position[i] = clean(place[Eigen::Index(i)]);
  to_frame.placement.rotation.rpy = angles(body.R.transpose() * R_WT);
  loop.from = add(from_frame);
  loop.to = add(to_frame);
  mechanism_.loops.push_back(loop);
}

/// A scalar coordinate or a component of a frame's position or of one of its axes, with its value.
std::pair<Expression, long double> LoopEnds::quantity() {
  const std::size_t joint = random_.below(mechanism_.joints.size());
  const auto& coordinates = mechanism_.joints[joint].coordinates;
  if (!coordinates.empty() && random_.chance(0.7)) {
    const std::size_t which = random_.below(coordinates.size());
    if (!coordinates[which].motion)
      return {variable(Variable::Kind::kPosition, joint, which),
              coordinates[which].initial_position.constant()};
  }
  const model::Frame frame = random_frame(model::BodyIndex(random_.below(mechanism_.bodies.size())));
  const std::size_t component = random_.below(3);
  if (random_.chance(0.3)) {
    const std::size_t axis = random_.below(3);
    return {variable(Variable::Kind::kFrameDirection, add(frame).value, 3 * component + axis),
            pose(frame).R(Eigen::Index(component), Eigen::Index(axis))};
  }
  const Long value = pose(frame).p[Eigen::Index(component)];
  return {variable(Variable::Kind::kFramePosition, add(frame).value, component), value};
}

void LoopEnds::add_residual(model::Loop& loop) {
  const auto [one, first] = quantity();
  const auto [other, second] = quantity();
  const double ratio = random_.sign() * random_.uniform(0.3, 2);
  const bool wavy = random_.chance(0.3);
  loop.residual = one - Expression(ratio) * (wavy ? sine(other) : other) -
                  Expression(double(first - ratio * (wavy ? std::sin(second) : second)));
  if (random_.chance(0.3)) loop.residual = loop.residual - departure(random_);
  mechanism_.loops.push_back(loop);
}

}  // namespace jourdain::tests
