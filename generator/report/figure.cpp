#include "report/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/joint_kinds.hpp"
#include "model/loop_kinds.hpp"

namespace jourdain::report {

namespace {

using model::Mechanism;
using model::Numbers3;

bool turns(const model::JointMotion& motion) {
  return motion.is_angular() || motion.kind == model::MotionKind::kBall;
}

/// What the joint is drawn about: where it turns, else where it slides; nothing where neither has a direction.
const model::JointMotion* drawn_motion(const model::JointKind& kind) {
  const auto turn = std::ranges::find_if(kind.motions, &model::JointMotion::is_angular);
  if (turn != kind.motions.end()) return &*turn;
  const auto slide = std::ranges::find(kind.motions, model::MotionKind::kSlide, &model::JointMotion::kind);
  return slide == kind.motions.end() ? nullptr : &*slide;
}

bool slides_along_axis(const model::JointMotion& motion) {
  return motion.kind == model::MotionKind::kSlide && motion.along == model::Along::kAxis;
}

Numbers3 unit(const Numbers3& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

class FigureMaker {
 public:
  FigureMaker(const Mechanism& mechanism, const std::vector<double>& parameters)
      : mechanism_(mechanism), parameters_(parameters) {}

  Figure make() {
    figure_.mechanism = mechanism_;
    figure_.mechanism.outputs.clear();
    figure_.gravity = numbers(mechanism_.gravity);
    holds_something_.resize(mechanism_.bodies.size());
    for (std::size_t b = 0; b < mechanism_.bodies.size(); ++b) add_body(b);
    for (const model::Joint& joint : mechanism_.joints) add_joint(joint);
    for (const model::Loop& loop : mechanism_.loops) add_loop(loop);
    for (const model::DrawnGround& ground : mechanism_.grounds) add_ground(ground);
    for_each_force_element(mechanism_, [this](const auto& element) { add_force_element(element.ends()); });
    for (std::size_t b = 0; b < mechanism_.bodies.size(); ++b)
      if (!holds_something_[b]) stick(b, figure_.bodies[b].center);
    return std::move(figure_);
  }

 private:
  double number(const model::Expression& e) const { return e.evaluate<double>(parameters_); }

  Numbers3 numbers(const model::Vector3& v) const { return {number(v[0]), number(v[1]), number(v[2])}; }

  void add_body(std::size_t index) {
    const model::Body& body = mechanism_.bodies[index];
    model::Frame frame;
    frame.name = fmt::format("figure_frame_{}", index);
    frame.body = model::BodyIndex(index);
    figure_.mechanism.frames.push_back(frame);
    model::Output output;
    output.name = fmt::format("figure_pose_{}", index);
    output.kind = model::OutputKind::kPose;
    output.frame = model::FrameIndex(figure_.mechanism.frames.size() - 1);
    figure_.mechanism.outputs.push_back(output);
    figure_.bodies.push_back({body.name, number(body.mass), numbers(body.center_of_mass)});
    if (body.shape) add_shape(index, *body.shape);
  }

  void add_shape(std::size_t index, const model::Shape& shape) {
    const model::Matrix3 R = model::rotation_from_rpy(numbers(mechanism_.bodies[index].inertia_axes.rpy));
    figure_.shapes.push_back({index, shape.kind, figure_.bodies[index].center, R, numbers(shape.size),
                              number(shape.radius), number(shape.length), shape.axis});
  }

  /// A line from the body's origin.
  void stick(std::size_t body, const Numbers3& to) {
    if (std::hypot(to[0], to[1], to[2]) == 0) return;
    figure_.lines.push_back({LineKind::kBody, {body, {}}, {body, to}});
  }

  FigurePoint point(std::optional<model::BodyIndex> body, const model::Placement& placement) {
    FigurePoint result{{}, numbers(placement.position)};
    if (!body) return result;
    result.body = body->value;
    holds_something_[body->value] = true;
    stick(body->value, result.position);
    return result;
  }

  FigurePoint attached(model::FrameIndex index) {
    const model::Frame& frame = mechanism_.frames[index.value];
    return point(frame.body, frame.placement);
  }

  /// A line between two ends.
  void add_force_element(const std::vector<model::FrameIndex>& ends) {
    std::vector<FigurePoint> points;
    for (const model::FrameIndex end : ends) points.push_back(attached(end));
    if (points.size() == 2) figure_.lines.push_back({LineKind::kSpring, points[0], points[1]});
  }

  /// The plane that it rolls on, or the ground over that.
  void add_ground(const model::Loop& loop) {
    const model::Frame& from = mechanism_.frames[loop.from.value];
    FigureGround ground;
    if (from.body) ground.body = from.body->value;
    ground.point = numbers(from.placement.position);
    ground.normal = axis_in(from.placement, loop.axis);
    const auto axes = model::plane_axes(unit(loop.axis));
    for (std::size_t i = 0; i < 2; ++i) ground.along[i] = axis_in(from.placement, axes[i]);
    add_ground(std::move(ground), loop.to, loop.height, axes, {});
  }

  /// At the start.
  void add_ground(const model::DrawnGround& drawn) {
    FigureGround ground;
    ground.normal = unit(drawn.normal);
    ground.along = model::plane_axes(ground.normal);
    const Numbers3 o = numbers(drawn.point);
    const double level = ground.normal[0] * o[0] + ground.normal[1] * o[1] + ground.normal[2] * o[2];
    for (std::size_t k = 0; k < 3; ++k) ground.point[k] = level * ground.normal[k];
    const auto along = ground.along;
    const Numbers3 point = ground.point;
    add_ground(std::move(ground), drawn.frame, drawn.height, along, point);
  }

  /// Its height is of the components `from` + a axes[0] + b axes[1].
  void add_ground(FigureGround ground, model::FrameIndex touching, const model::Expression& height,
                  const std::array<Numbers3, 2>& axes, const Numbers3& from) {
    const std::optional<model::BodyIndex> body = mechanism_.frames[touching.value].body;
    if (!body) return;
    if (!height.is_zero())
      ground.height = [height, axes, from, parameters = parameters_](double a, double b) {
        return height.evaluate<double>(
            parameters, [](double literal) { return literal; },
            [&](const model::Variable& v) {
              if (v.kind == model::Variable::Kind::kTime) return 0.0;
              return from[v.component] + a * axes[0][v.component] + b * axes[1][v.component];
            });
      };
    const auto same =
        std::ranges::find_if(figure_.grounds, [&](const FigureGround& g) { return is_same(g, ground); });
    FigureGround& one =
        same != figure_.grounds.end() ? *same : figure_.grounds.emplace_back(std::move(ground));
    one.touching.push_back(body->value);
  }

  /// Of two heights some values are enough to tell.
  static bool is_same(const FigureGround& a, const FigureGround& b) {
    if (a.body != b.body || a.point != b.point || a.normal != b.normal || !a.height != !b.height)
      return false;
    if (!a.height) return true;
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {0.37, 0.21}, {-1.3, 0.7}, {2.9, -3.1}})
      if (a.height(x, y) != b.height(x, y)) return false;
    return true;
  }

  Numbers3 axis_in(const model::Placement& placement, const std::array<double, 3>& axis) const {
    return model::product(model::rotation_from_rpy(numbers(placement.rotation.rpy)), unit(axis));
  }

  void add_joint(const model::Joint& joint) {
    const model::JointKind& kind = model::joint_kind(joint);
    figure_.flies |= kind.has_quaternion();
    if (kind.has_origin()) return;
    const model::JointMotion* about = drawn_motion(kind);
    FigureJoint drawn{point(joint.parent, joint.placement),
                      {},
                      std::ranges::any_of(kind.motions, turns),
                      std::ranges::any_of(kind.motions, slides_along_axis),
                      joint.child.value};
    if (about) drawn.axis = axis_in(joint.placement, model::direction(joint, *about));
    figure_.joints.push_back(drawn);
    if (!drawn.turns || std::ranges::any_of(kind.motions, &model::JointMotion::displaces))
      figure_.lines.push_back({LineKind::kSlide, drawn.at, {joint.child.value, {}}});
  }

  void add_loop(const model::Loop& loop) {
    const model::LoopKind& kind = model::loop_kind(loop);
    if (kind.is_constraint()) {
      if (kind.takes("height")) add_ground(loop);
      return add_round(loop);
    }
    if (!kind.has_ends()) return;
    const FigurePoint from = attached(loop.from), to = attached(loop.to);
    figure_.lines.push_back({kind.is_bar() ? LineKind::kBody : LineKind::kSlide, from, to});
    for (const FigurePoint& end : {from, to}) figure_.joints.push_back({end, {}, true, false, {}});
  }

  /// What rolls: three sections of it, of a wheel the one across its axle.
  void add_round(const model::Loop& loop) {
    const model::LoopKind& kind = model::loop_kind(loop);
    if (!kind.takes("radius") && !kind.takes("radii")) return;
    const model::Frame& frame = mechanism_.frames[loop.to.value];
    if (!frame.body) return;
    const FigurePoint centre = attached(loop.to);
    const auto ring = [&](const Numbers3& u, const Numbers3& v) {
      constexpr int kSides = 32;
      const auto at = [&](int side) {
        const double angle = 2 * std::numbers::pi * side / kSides;
        FigurePoint point = centre;
        for (std::size_t k = 0; k < 3; ++k)
          point.position[k] += std::cos(angle) * u[k] + std::sin(angle) * v[k];
        return point;
      };
      for (int side = 0; side < kSides; ++side)
        figure_.lines.push_back({LineKind::kBody, at(side), at(side + 1)});
    };
    const double radius = number(loop.length);
    const Numbers3 radii = kind.takes("radii") ? numbers(loop.radii) : Numbers3{radius, radius, radius};
    const auto along = [&](const std::array<double, 3>& direction, double length) {
      Numbers3 v = axis_in(frame.placement, direction);
      for (double& entry : v) entry *= length;
      return v;
    };
    if (kind.takes("axis")) {
      const auto [u, v] = model::plane_axes(unit(loop.to_axis));
      return ring(along(u, radius), along(v, radius));
    }
    const Numbers3 x = along({1, 0, 0}, radii[0]), y = along({0, 1, 0}, radii[1]),
                   z = along({0, 0, 1}, radii[2]);
    ring(x, y);
    ring(y, z);
    ring(z, x);
  }

  const Mechanism& mechanism_;
  const std::vector<double>& parameters_;
  Figure figure_;
  std::vector<bool> holds_something_;  // by body
};

}  // namespace

Figure make_figure(const Mechanism& mechanism, const std::vector<double>& parameters) {
  return FigureMaker(mechanism, parameters).make();
}

}  // namespace jourdain::report
