#include "properties/placed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/joint_kinds.hpp"

namespace jourdain::tests {

using model::JointType;
using model::LoopType;

namespace {

constexpr double kSame = 1e-9;  // m; points that are nearer to each other count as one

std::array<double, 3> numbers(const Point3& p) { return {p.x(), p.y(), p.z()}; }

Eigen::Matrix3d about_z(double angle) { return Eigen::AngleAxisd(angle, Point3::UnitZ()).toRotationMatrix(); }

LoopType loop_type(JointType type, bool pins) {
  if (pins && type == JointType::kRevolute) return LoopType::kPlanarPin;
  return model::joint_kind(type).as_loop.value_or(LoopType::kBall);
}

}  // namespace

std::size_t PlacedScene::add_free_body() {
  free_.push_back(bodies_);
  return bodies_++;
}

void PlacedScene::turn(const Eigen::Matrix3d& R) {
  const auto turn = [&](Point3& p) { p = (R * p).eval(); };
  for (PlacedJoint& joint : joints_) turn(joint.point), turn(joint.axis), turn(joint.second_axis);
  for (PlacedRod& rod : rods_) turn(rod.from), turn(rod.to);
}

model::Mechanism PlacedScene::mechanism(const SceneOptions& options) {
  options_ = options;
  linkage_ = {};
  poses_.assign(bodies_, {});
  reached_.assign(bodies_, false);
  in_tree_.assign(joints_.size(), false);
  for (std::size_t b = 0; b < bodies_; ++b) linkage_.add_plate(1.0, 0.0, 0.0, 1.0);
  grow_tree();
  fill_bodies();
  add_loops();
  return std::move(linkage_.mechanism);
}

void PlacedScene::grow_tree() {
  for (std::size_t b = 0; b < bodies_; ++b)
    if (options_.absolute || std::find(free_.begin(), free_.end(), b) != free_.end()) attach_free(b);
  while (attach_one()) {
  }
  JD_CHECK(std::find(reached_.begin(), reached_.end(), false) == reached_.end(), "a body hangs on nothing");
}

/// Any joint from what is reached to what is not; slides first, which then are coordinates.
bool PlacedScene::attach_one() {
  const auto reached = [&](const OptionalBody& body) { return !body || reached_[*body]; };
  std::vector<std::size_t> candidates, slides;
  for (std::size_t j = 0; j < joints_.size(); ++j)
    if (reached(joints_[j].a) != reached(joints_[j].b))
      (joints_[j].type == JointType::kPrismatic ? slides : candidates).push_back(j);
  if (!slides.empty()) candidates = slides;
  if (candidates.empty()) return false;
  const std::size_t chosen = candidates[random_.below(candidates.size())];
  in_tree_[chosen] = true;
  PlacedJoint joint = joints_[chosen];
  if (!reached(joint.a)) {
    std::swap(joint.a, joint.b);
    if (joint.type == JointType::kUniversal) std::swap(joint.axis, joint.second_axis);
  }
  attach(joint);
  return true;
}

void PlacedScene::attach_free(std::size_t body) {
  const std::vector<Point3> points = attachments(body);
  poses_[body].p = points.front();
  model::Joint& joint = linkage_.add_joint(JointType::kFree, {}, body);
  for (Eigen::Index i = 0; i < 3; ++i) joint.initial_origin[std::size_t(i)] = poses_[body].p[i];
  reached_[body] = true;
}

/// Of the child's frame; in the plane its x axis leads from the joint to the next one on the body.
PlacedScene::Pose PlacedScene::child_pose(const PlacedJoint& joint, const Pose& parent,
                                          std::size_t child) const {
  Pose result{parent.R, joint.point};
  if (!options_.planar || joint.type != JointType::kRevolute) return result;
  for (const Point3& other : attachments(child)) {
    const Point3 bar = other - joint.point;
    if (bar.norm() < kSame) continue;
    result.R = about_z(std::atan2(bar.y(), bar.x()));
    break;
  }
  return result;
}

void PlacedScene::attach(const PlacedJoint& joint) {
  const std::size_t child = *joint.b;
  const Pose parent = pose(joint.a), placed = child_pose(joint, parent, child);
  const Eigen::Matrix3d R = parent.R.transpose();
  double start = 0;
  if (options_.planar && joint.type == JointType::kRevolute) {
    const Eigen::Matrix3d turn = R * placed.R;
    start = std::atan2(turn(1, 0), turn(0, 0));
  }
  if (joint.type == JointType::kPrismatic && joint.stiffness == 0) start = random_.uniform(-0.5, 0.5);
  const Point3 slid = joint.type == JointType::kPrismatic ? Point3(start * joint.axis) : Point3::Zero();
  model::Joint& made = linkage_.add_joint(joint.type, joint.a, child, {}, numbers(R * joint.axis));
  made.second_axis = numbers(R * joint.second_axis);
  made.placement.position = position(R * (joint.point - parent.p - slid));
  for (model::Coordinate& coordinate : made.coordinates) {
    coordinate.initial_position = start;
    if (joint.type == JointType::kPrismatic) coordinate.stiffness = joint.stiffness;
  }
  poses_[child] = placed;
  reached_[child] = true;
}

void PlacedScene::add_loops() {
  for (std::size_t j = 0; j < joints_.size(); ++j)
    if (!in_tree_[j]) close(joints_[j]);
  for (const PlacedRod& rod : rods_) {
    const model::FrameIndex from = frame(rod.a, rod.from), to = frame(rod.b, rod.to);
    linkage_.add_loop(LoopType::kRod, from, to).length = (rod.to - rod.from).norm();
  }
}

void PlacedScene::close(PlacedJoint joint) {
  if (joint.type != JointType::kUniversal) joint.second_axis = joint.axis;
  if (random_.chance(0.5)) {
    std::swap(joint.a, joint.b);
    std::swap(joint.axis, joint.second_axis);
  }
  const bool pins = options_.planar && !options_.spatial_closing;
  const model::FrameIndex from = frame(joint.a, joint.point), to = frame(joint.b, joint.point);
  model::Loop& loop = linkage_.add_loop(loop_type(joint.type, pins), from, to);
  loop.axis = numbers(pins ? joint.axis : Point3(pose(joint.a).R.transpose() * joint.axis));
  loop.to_axis = numbers(pose(joint.b).R.transpose() * joint.second_axis);
}

/// Where joints and rods are on the body.
std::vector<Point3> PlacedScene::attachments(std::size_t body) const {
  std::vector<Point3> points;
  for (const PlacedJoint& joint : joints_)
    if (joint.a == body || joint.b == body) points.push_back(joint.point);
  for (const PlacedRod& rod : rods_) {
    if (rod.a == body) points.push_back(rod.from);
    if (rod.b == body) points.push_back(rod.to);
  }
  return points;
}

/// Masses of some kilograms about the middle of what a body carries, as wide as that.
void PlacedScene::fill_bodies() {
  for (std::size_t b = 0; b < bodies_; ++b) {
    model::Body& body = linkage_.mechanism.bodies[b];
    const std::vector<Point3> points = attachments(b);
    Point3 middle = Point3::Zero();
    for (const Point3& p : points) middle += p / double(points.size());
    double width = 0.1;
    for (const Point3& p : points) width = std::max(width, (p - middle).norm());
    const Point3 aside(random_.uniform(-0.2, 0.2), random_.uniform(-0.2, 0.2), random_.uniform(-0.2, 0.2));
    const Point3 center = poses_[b].R.transpose() * (middle + width * aside - poses_[b].p);
    const double mass = random_.uniform(0.5, 3), moment = mass * width * width / 3;
    body.mass = mass;
    body.center_of_mass = {center.x(), center.y(), options_.planar ? 0.0 : center.z()};
    body.inertia.xx = moment * random_.uniform(0.8, 1.3);
    body.inertia.yy = moment * random_.uniform(0.8, 1.3);
    body.inertia.zz = moment * random_.uniform(0.8, 1.3);
  }
}

const PlacedScene::Pose& PlacedScene::pose(const OptionalBody& body) const {
  static const Pose kWorld;
  return body ? poses_[*body] : kWorld;
}

model::FrameIndex PlacedScene::frame(const OptionalBody& body, const Point3& point) {
  const Pose& at = pose(body);
  return linkage_.add_frame(body, position(at.R.transpose() * (point - at.p)));
}

/// Each length that is not zero a parameter, where lengths are tunable.
model::Vector3 PlacedScene::position(const Point3& p) {
  model::Vector3 result;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double value = std::fabs(p[i]) < 1e-15 ? 0.0 : p[i];
    result[std::size_t(i)] = value;
    if (!options_.tunable || value == 0) continue;
    std::vector<model::Parameter>& parameters = linkage_.mechanism.parameters;
    parameters.push_back({fmt::format("l{}", parameters.size()), value, "m", "", {}});
    result[std::size_t(i)] = model::Expression::parameter(model::ParameterIndex(parameters.size() - 1));
  }
  return result;
}

Eigen::Matrix3d random_rotation(Random& random) {
  Eigen::Vector4d wxyz;
  do
    for (double& x : wxyz) x = random.uniform(-1, 1);
  while (wxyz.norm() < 0.3);
  return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
}

model::Mechanism rounded(model::Mechanism mechanism, int decimals) {
  const double unit = std::pow(10.0, decimals);
  const auto rounded_number = [&](double x) { return std::round(x * unit) / unit; };
  const auto round_axis = [&](std::array<double, 3>& axis) {
    for (double& x : axis) x = rounded_number(x);
  };
  const auto round_position = [&](model::Vector3& position) {
    for (model::Expression& x : position)
      if (x.is_constant()) x = rounded_number(x.constant());
  };
  for (model::Parameter& parameter : mechanism.parameters) parameter.value = rounded_number(parameter.value);
  for (model::Joint& joint : mechanism.joints) {
    round_axis(joint.axis), round_axis(joint.second_axis);
    round_position(joint.placement.position);
  }
  for (model::Frame& frame : mechanism.frames) round_position(frame.placement.position);
  for (model::Loop& loop : mechanism.loops) round_axis(loop.axis), round_axis(loop.to_axis);
  return mechanism;
}

model::Mechanism tilted(model::Mechanism mechanism, double angle, Random& random) {
  std::vector<model::Loop*> with_axes;
  for (model::Loop& loop : mechanism.loops)
    if (loop.type == LoopType::kRevolute || loop.type == LoopType::kCylindrical) with_axes.push_back(&loop);
  if (with_axes.empty()) return mechanism;
  std::array<double, 3>& axis = with_axes[random.below(with_axes.size())]->to_axis;
  const Point3 w(axis.data()), u = w.unitOrthogonal(), v = w.cross(u);
  const double way = random.uniform(-3, 3);
  axis = numbers(w + angle * (std::cos(way) * u + std::sin(way) * v));
  return mechanism;
}

}  // namespace jourdain::tests
