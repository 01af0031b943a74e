#include "dynamics/closure.hpp"

#include <fmt/format.h>

#include "dynamics/applied_forces.hpp"
#include "dynamics/free_root.hpp"
#include "dynamics/moving_vector.hpp"
#include "dynamics/points.hpp"
#include "dynamics/rolling_ground.hpp"
#include "kinematics/numbers.hpp"
#include "model/loop_kinds.hpp"

namespace jourdain::dynamics {

using model::Loop;
using model::LoopType;

namespace {

/// A frame seen from a link further in: its origin and directions fixed to it, in W of that link.
class SeenFrame {
 public:
  SeenFrame(const Scene& scene, const model::Frame& frame, std::size_t ancestor, const std::string& name)
      : scene_(scene),
        pose_(frame_pose(scene, frame)),
        path_(follow_point(scene, pose_.link, pose_.r_LB, ancestor, name)),
        name_(name) {}

  MovingVector position() const { return moving_point(scene_, path_, name_ + "m"); }

  /// Of a direction given in the frame.
  MovingVector direction(const Vector3& given) const {
    const Vector3 v_L = kinematics::settled(pose_.R_LB * given);
    const Vector3 v_W = scene_.frames.to_working(pose_.link, v_L, name_ + "d");
    return moving_direction(scene_, path_, v_W, name_ + "d");
  }

  const PointPath& path() const { return path_; }

 private:
  const Scene& scene_;
  kinematics::BodyPose pose_;
  PointPath path_;
  std::string name_;
};

using Axes = std::array<Vector3, 2>;

/// plane_axes of a unit vector with 60 digits: doubles would leave axes that are orthogonal to 1e-16 only.
Axes plane_axes(const std::array<double, 3>& axis) {
  const Vector3 n = kinematics::unit_vector(axis);
  for (std::size_t k = 0; k < 3; ++k)
    if (n[k].is_equal(1)) {
      Axes axes = {kinematics::zero_vector(), kinematics::zero_vector()};
      axes[0][(k + 1) % 3] = axes[1][(k + 2) % 3] = 1;
      return axes;
    }
  if (n[2].is_equal(-1)) return {Vector3{1, 0, 0}, Vector3{0, -1, 0}};
  const Vector3 across = kinematics::cross({0, 0, 1}, n);
  const Ex length = kinematics::square_root(dot(across, across));
  const Vector3 first = Ex(1 / length) * across;
  return {first, kinematics::cross(n, first)};
}

/// Of the origins. What the sides bind, they bind in this order with every compiler.
MovingVector from_to(const SeenFrame& a, const SeenFrame& b) {
  const MovingVector begin = a.position();
  return b.position() - begin;
}

/// One loop.
class Closure {
 public:
  Closure(const Scene& scene, const Loop& loop)
      : scene_(scene),
        loop_(loop),
        from_(scene.mechanism.frames[loop.from.value]),
        to_(scene.mechanism.frames[loop.to.value]),
        ancestor_(common_ancestor(scene.tree, scene.tree.link_of(from_.body), scene.tree.link_of(to_.body))),
        carrier_(model::carrier(scene.mechanism, from_.body, to_.body)),
        a_(scene, from_, ancestor_, loop.name + "a"),
        b_(scene, to_, ancestor_, loop.name + "b"),
        difference_(from_to(a_, b_)) {
    difference_.value = scene.statements.bind(loop.name + "d", difference_.value);
    difference_.first = scene.statements.bind(loop.name + "dv", difference_.first);
    difference_.second = scene.statements.bind(loop.name + "da", difference_.second);
  }

  LoopClosure close(ClosureRates rates) {
    write_rows();
    for (Ex& row : closure_.rows) row = scene_.statements.bind("g_" + loop_.name, kinematics::settled(row));
    for (Ex& sense : closure_.senses)
      sense = scene_.statements.bind("sense_" + loop_.name, kinematics::settled(sense));
    if (rates == ClosureRates::kGiven && closure_.velocities.empty())
      for (std::size_t r = 0; r < closure_.rows.size(); ++r) add_slopes(r);
    return std::move(closure_);
  }

 private:
  void add_row(const kinematics::Taylor& row, const RowGradient& gradient) {
    closure_.rows.push_back(row.value);
    closure_.rates.push_back(scene_.statements.bind("rate_" + loop_.name, row.first));
    closure_.biases.push_back(scene_.statements.bind("bias_" + loop_.name, row.second));
    closure_.gradients.push_back(gradient);
  }

  /// Along a direction fixed in `from`.
  void hold_along(const Vector3& axis) {
    const MovingVector along = a_.direction(axis);
    add_row(product(along, difference_),
            {.place = along.value, .turn_from = kinematics::cross(along.value, difference_.value)});
  }

  void hold_in_carrier(const std::vector<Vector3>& axes) {
    const auto seen = [&](const Vector3& v, const char* what) {
      return in_carrier(carrier_, v, loop_.name + what);
    };
    const MovingVector difference{seen(difference_.value, ""), seen(difference_.first, "v"),
                                  seen(difference_.second, "a")};
    for (const Vector3& axis : axes) {
      const Vector3 along = from_carrier(carrier_, axis, loop_.name);
      add_row(product({.value = axis}, difference),
              {.place = along, .turn_carrier = kinematics::cross(along, difference_.value)});
    }
  }

  /// Of a direction of `from` and one of `to`.
  void hold_axes_across(const Vector3& of_a, const Vector3& of_b) {
    const MovingVector w = b_.direction(of_b);
    hold_across(a_.direction(of_a), w);
  }

  void keep_sense(const Vector3& of_a, const Vector3& of_b) {
    const MovingVector w = b_.direction(of_b);
    closure_.senses.push_back(dot(a_.direction(of_a).value, w.value));
  }

  void hold_across(const MovingVector& u, const MovingVector& w) {
    const Vector3 turn = kinematics::cross(u.value, w.value);
    add_row(product(u, w), {.turn_from = turn, .turn_to = Ex(-1) * turn});
  }

  void hold_points(const Axes& from_axes) {
    for (const Vector3& axis : from_axes) hold_along(axis);
  }

  void hold_parallel(const Axes& from_axes) {
    const MovingVector w = b_.direction(kinematics::unit_vector(loop_.to_axis));
    for (const Vector3& axis : from_axes) hold_across(a_.direction(axis), w);
    closure_.senses = {dot(a_.direction(kinematics::unit_vector(loop_.axis)).value, w.value)};
  }

  /// (Δ·Δ/l − l)/2, with a length that may be a function of time.
  void hold_length() {
    kinematics::Statements& statements = scene_.statements;
    const Ex l = general_value(scene_, loop_.name + "l", loop_.length, Inputs::kZero);
    const kinematics::Taylor length =
        kinematics::differentiated(loop_.length, scene_.leaves.t, scene_.leaves.parameters, statements);
    closure_.span = Span{difference_.value, l};
    const kinematics::Taylor square = product(difference_, difference_);
    const Ex inverse = statements.bind(loop_.name + "il", 1 / l);
    const Ex value = statements.bind(loop_.name + "ll", square.value);
    const Ex ratio = statements.bind(loop_.name + "lr", value * inverse * inverse);
    const Ex twice = statements.bind(loop_.name + "lv", inverse * square.first / 2);
    time_rate_ = -length.first * (ratio + 1) / 2;
    const Ex bias = inverse * square.second / 2 - length.second * (ratio + 1) / 2 +
                    length.first * inverse * (length.first * ratio - 2 * twice);
    add_row({(value - l * l) / (2 * l), twice + time_rate_, bias}, {.place = Ex(1 / l) * difference_.value});
  }

  void write_rows() {
    const Axes from_axes = plane_axes(loop_.axis), to_axes = plane_axes(loop_.to_axis);
    const Vector3 n = kinematics::unit_vector(loop_.axis);
    const auto coincide = [&] { hold_in_carrier({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}); };
    switch (loop_.type) {
      case LoopType::kBall:
        return coincide();
      case LoopType::kRevolute:
        coincide();
        return hold_parallel(from_axes);
      case LoopType::kUniversal:
        coincide();
        return hold_axes_across(n, kinematics::unit_vector(loop_.to_axis));
      case LoopType::kPrismatic:
        hold_points(from_axes);
        hold_parallel(from_axes);
        hold_axes_across(from_axes[0], to_axes[1]);
        return keep_sense(from_axes[0], to_axes[0]);
      case LoopType::kCylindrical:
        hold_points(from_axes);
        return hold_parallel(from_axes);
      case LoopType::kPlanarPin:
        return hold_in_carrier({from_axes[0], from_axes[1]});
      case LoopType::kPointInPlane:
        return hold_along(n);
      case LoopType::kPointOnLine:
        return hold_points(from_axes);
      case LoopType::kRod:
        return hold_length();
      case LoopType::kKnifeEdge:
        return hold_back(b_.direction(kinematics::unit_vector(loop_.to_axis)).value,
                         kinematics::zero_vector(), loop_.name + "s");
      case LoopType::kRollingWheel:
      case LoopType::kRollingBall:
      case LoopType::kRollingEllipsoid:
        return roll(a_.direction(n).value, from_axes);
      case LoopType::kResidual:
      case LoopType::kVelocity:
        break;
    }
    JD_CHECK(false, "an expression is no row of two frames");
  }

  /// Where a body is lowest: how far below its origin, and from there to that point.
  struct Lowest {
    Ex depth;
    Vector3 lever;
  };

  Ex length(const model::Expression& given, const std::string& name) const {
    return general_value(scene_, loop_.name + name, given, Inputs::kZero);
  }

  Lowest of_ball(const Vector3& n) const {
    const Ex radius = length(loop_.length, "l");
    return {radius, Ex(-radius) * n};
  }

  /// A disc of no width about w.
  Lowest of_wheel(const Vector3& n) const {
    kinematics::Statements& statements = scene_.statements;
    const Ex radius = length(loop_.length, "l");
    const Vector3 w = b_.direction(kinematics::unit_vector(loop_.to_axis)).value;
    const Ex lean = statements.bind(loop_.name + "nw", dot(n, w));
    const Ex upright = statements.bind(loop_.name + "up", kinematics::square_root(1 - lean * lean));
    return {radius * upright, Ex(-radius / upright) * (n - lean * w)};
  }

  Lowest of_ellipsoid(const Vector3& n) const {
    kinematics::Statements& statements = scene_.statements;
    Ex square = 0;
    Vector3 lever = kinematics::zero_vector();
    for (std::size_t k = 0; k < 3; ++k) {
      Vector3 along = kinematics::zero_vector();
      along[k] = 1;
      const std::string name = fmt::format("{}e{}", loop_.name, k);
      const Vector3 e = b_.direction(along).value;
      const Ex share = statements.bind(name + "n", dot(n, e));
      const Ex radius = length(loop_.radii[k], fmt::format("r{}", k));
      const Ex weighed = statements.bind(name + "s", radius * radius * share);
      square = statements.bind(name + "q", square + weighed * share);
      lever = statements.bind(name + "l", lever - weighed * e);
    }
    const Ex depth = statements.bind(loop_.name + "d", kinematics::square_root(square));
    return {depth, Ex(1 / depth) * lever};
  }

  void roll(const Vector3& n, const Axes& from_axes) {
    if (!loop_.height.is_zero()) return roll_on_ground(n, from_axes);
    const auto [depth, way] = loop_.type == LoopType::kRollingBall    ? of_ball(n)
                              : loop_.type == LoopType::kRollingWheel ? of_wheel(n)
                                                                      : of_ellipsoid(n);
    const Vector3 lever = scene_.statements.bind(loop_.name + "c", way);
    closure_.rows.push_back(dot(n, difference_.value) - depth);
    closure_.gradients.push_back(touching(n, lever));
    for (std::size_t k = 0; k < 2; ++k)
      hold_back(a_.direction(from_axes[k]).value, lever, fmt::format("{}s{}", loop_.name, k));
  }

  void roll_on_ground(const Vector3& n, const Axes& from_axes) {
    kinematics::Statements& statements = scene_.statements;
    const std::string name = loop_.name + "g";
    const Vector3 axes[3] = {a_.direction(from_axes[0]).value, a_.direction(from_axes[1]).value, n};
    const auto seen = [&](const Vector3& v) {
      return statements.bind(name + "p", Vector3{dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)});
    };
    const auto back = [&](const Vector3& v) {
      return statements.bind(name + "v", v[0] * axes[0] + v[1] * axes[1] + v[2] * axes[2]);
    };
    const Vector3 centre = seen(difference_.value);
    const RoundShape round =
        round_shape(scene_, loop_, [&](const Vector3& v) { return seen(b_.direction(v).value); });
    const GroundTouch touch = touch_ground(scene_, loop_, from_axes, centre, round);
    closure_.searches.push_back(touch.search);
    const Vector3 lever = back(touch.lever);
    closure_.rows.push_back(touch.height);
    closure_.gradients.push_back(touching(back(touch.normal), lever));
    for (std::size_t k = 0; k < 2; ++k)
      hold_back(back(touch.along[k]), lever, fmt::format("{}s{}", loop_.name, k));
  }

  /// Of the velocity along `e` of the point of the body of `to` at `lever` from its origin, relative to the body of
  /// `from`.
  RowGradient touching(const Vector3& e, const Vector3& lever) const {
    return {.place = e,
            .turn_from = kinematics::cross(e, difference_.value + lever),
            .turn_to = kinematics::cross(lever, e)};
  }

  /// That velocity is zero.
  void hold_back(const Vector3& e, const Vector3& lever, const std::string& name) {
    const std::size_t row = closure_.rows.size();
    closure_.rows.emplace_back(0);
    closure_.gradients.push_back(touching(e, lever));
    add_slopes(row);
    Ex velocity = closure_.time_slopes.back();
    for (const auto& [entry, slope] : closure_.slopes.back()) velocity += slope * scene_.leaves.z[entry];
    closure_.velocities[row] = scene_.statements.bind(name, velocity);
    closure_.slopes.clear();
    closure_.time_slopes.clear();
  }

  /// G and g_t of a row: its gradient on the columns of the links on the way to either frame.
  void add_slopes(std::size_t row) {
    const RowGradient& gradient = closure_.gradients[row];
    closure_.slopes.emplace_back();
    closure_.time_slopes.push_back(time_rate_);
    const std::string name = fmt::format("{}s{}", loop_.name, row);
    add_side(a_.path(), {Ex(-1) * gradient.place, gradient.turn_from}, name + "a");
    add_side(b_.path(), {gradient.place, gradient.turn_to}, name + "b");
  }

  void add_side(const PointPath& path, const Wrench& wrench, const std::string& name) {
    const std::vector<Vector3> forces = carry_outward(scene_, path, wrench.force, name + "f"),
                               moments = carry_outward(scene_, path, wrench.moment, name + "n");
    for (std::size_t k = 0; k < path.links.size(); ++k)
      add_link(path.links[k],
               {forces[k], scene_.statements.bind(name + "m", moments[k] + cross(path.levers[k], forces[k]))},
               wrench.force, name);
  }

  /// `force_A` is the force in axes of the ancestor: those that the velocity of a free link is in.
  void add_link(std::size_t j, const Wrench& here, const Vector3& force_A, const std::string& name) {
    if (!scene_.states[j].entry) {
      Ex& sum = closure_.time_slopes.back();
      sum = scene_.statements.bind(name + "t", sum + power(here, scene_.relative_twist(j)));
      return;
    }
    Wrench seen = to_external(scene_, j, here, name);
    if (is_free(scene_.tree.links[j])) seen.force = force_A;
    for (const Column& column : scene_.columns[j]) {
      const Ex share = power(seen, column.twist);
      if (share.is_zero()) continue;
      Ex& sum = closure_.slopes.back()[*column.entry];
      sum = scene_.statements.bind(name + "p", sum + share);
    }
  }

  /// Components in the carrier's axes of a vector in W of the carrier's link.
  Vector3 in_carrier(std::optional<model::BodyIndex> carrier, const Vector3& v, const std::string& name) {
    if (!carrier) return v;
    const kinematics::BodyPose& pose = scene_.tree.bodies[carrier->value];
    const Vector3 v_L = scene_.frames.to_link(pose.link, v, name + "c");
    return scene_.statements.bind(name + "c", transpose(pose.R_LB) * v_L);
  }

  /// The way back.
  Vector3 from_carrier(std::optional<model::BodyIndex> carrier, const Vector3& v, const std::string& name) {
    if (!carrier) return v;
    const kinematics::BodyPose& pose = scene_.tree.bodies[carrier->value];
    return scene_.frames.to_working(pose.link, scene_.statements.bind(name + "e", pose.R_LB * v), name + "e");
  }

  const Scene& scene_;
  const Loop& loop_;
  const model::Frame &from_, &to_;
  std::size_t ancestor_;
  std::optional<model::BodyIndex> carrier_;
  SeenFrame a_, b_;
  MovingVector difference_;
  Ex time_rate_ = 0;  ///< of the row at rest
  LoopClosure closure_;
};

}  // namespace

std::vector<LoopClosure> derive_closure(const Scene& scene, ClosureRates rates) {
  std::vector<LoopClosure> closures;
  for (const Loop& loop : scene.mechanism.loops)
    if (model::loop_kind(loop).has_ends()) {
      closures.push_back(Closure(scene, loop).close(rates));
    } else {
      const Ex value = scene.statements.bind(
          "g_" + loop.name,
          kinematics::settled(general_value(scene, loop.name, loop.residual, Inputs::kZero)));
      LoopClosure& closure = closures.emplace_back();
      closure.rows = {loop.type == LoopType::kVelocity ? Ex(0) : value};
      if (loop.type == LoopType::kVelocity) closure.velocities[0] = value;
    }
  return closures;
}

}  // namespace jourdain::dynamics
