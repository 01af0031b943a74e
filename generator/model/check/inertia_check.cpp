// Could these inertias belong to rigid bodies?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/check/checks.hpp"
#include "model/matrix3.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;
using support::shown;

/// Rounding of a negative moment that is forgiven, relative to the largest moment (about the origin, so that
/// cancellation by moving to the centre of mass is covered).
constexpr double kMomentTolerance = 1e-9;
/// Of the largest principal moment, by which the triangle inequality may be missed: numbers of a few digits.
constexpr double kTriangleRounding = 0.01;

/// Mass moments of one or several bodies about the origin of a common frame. kg, kg m, kg m².
struct MassMoments {
  double mass = 0;
  Numbers3 first{};
  Matrix3 inertia{};
};

struct Pose {
  Numbers3 origin{};
  Matrix3 R = kIdentity3;
};

/// Bodies joined by fixed joints, in the frame of the first one.
struct Group {
  std::vector<std::size_t> bodies;
  bool lumped = false;
  MassMoments moments;
};

Matrix3 negated(const Matrix3& a) { return scaled(a, -1); }

double largest_moment(const Matrix3& a) {
  return std::max({std::abs(a[0][0]), std::abs(a[1][1]), std::abs(a[2][2])});
}

/// Inertia about the centre of mass; about the origin where there is no mass.
Matrix3 central_inertia(const MassMoments& m) {
  if (m.mass == 0) return m.inertia;
  const Numbers3 c{m.first[0] / m.mass, m.first[1] / m.mass, m.first[2] / m.mass};
  return sum(m.inertia, negated(scaled(point_inertia(c), m.mass)));
}

/// The moments in a frame in which the old one stands at `pose`.
MassMoments moved(const MassMoments& m, const Pose& pose) {
  // I' = R I Rᵀ + (cross terms of R·first with the origin) + mass · point_inertia(origin)
  const Numbers3 h = product(pose.R, m.first);
  const Numbers3& p = pose.origin;
  const double dot = p[0] * h[0] + p[1] * h[1] + p[2] * h[2];
  Matrix3 inertia = sum(turned(pose.R, m.inertia), scaled(point_inertia(p), m.mass));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) inertia[i][j] += (i == j ? 2 * dot : 0) - h[i] * p[j] - p[i] * h[j];
  return {m.mass, sum(h, {m.mass * p[0], m.mass * p[1], m.mass * p[2]}), inertia};
}

class InertiaCheck {
 public:
  InertiaCheck(const Mechanism& mechanism, Diagnostics& diagnostics, support::Severity triangle)
      : mechanism_(mechanism),
        diagnostics_(diagnostics),
        triangle_(triangle),
        values_(default_values(mechanism)) {}

  std::vector<std::string> run() {
    const std::vector<Group> all = groups();
    for (std::size_t g = 0; g < all.size(); ++g)
      for (const std::size_t b : all[g].bodies) check_body(mechanism_.bodies[b], all[g], g == 0);
    for (const Group& group : all)
      if (!group.lumped) check_triangle(group);
    return std::move(indefinite_);
  }

 private:
  double number(const Expression& e) const { return e.evaluate<double>(values_); }
  Numbers3 numbers(const Vector3& v) const { return {number(v[0]), number(v[1]), number(v[2])}; }

  /// About the origin of the body's frame, in its axes.
  MassMoments moments(const Body& body) const {
    const double mass = number(body.mass);
    const Numbers3 c = numbers(body.center_of_mass);
    const double xx = number(body.inertia.xx), yy = number(body.inertia.yy), zz = number(body.inertia.zz);
    const double xy = number(body.inertia.xy), xz = number(body.inertia.xz), yz = number(body.inertia.yz);
    const Matrix3 R = rotation_from_rpy(numbers(body.inertia_axes.rpy));
    const Matrix3 given = turned(R, {{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}});
    const bool central = body.inertia_point == InertiaPoint::kCenterOfMass;
    const Matrix3 inertia = central ? sum(given, scaled(point_inertia(c), mass)) : given;
    return {mass, {mass * c[0], mass * c[1], mass * c[2]}, inertia};
  }

  /// Where others are fixed to it, or nothing moves it, only the sum counts.
  void check_body(const Body& body, const Group& group, bool is_at_rest) {
    const MassMoments m = moments(body);
    if (m.mass < 0) return;  // reported by check_numbers; its inertia means nothing
    const double allowed = kMomentTolerance * largest_moment(m.inertia);
    const SourceRange where = body.inertia_where.line == 0 ? body.where : body.inertia_where;
    if (body.lumped) {
      const double least = std::min({m.inertia[0][0], m.inertia[1][1], m.inertia[2][2]});
      if (least < -allowed)
        diagnostics_.error(
            where, fmt::format("body '{}' has a negative moment of inertia about its origin: {:.5g} kg m^2",
                               shown(body.name), least));
      return;
    }
    const Numbers3 moment = symmetric_eigenvalues(central_inertia(m));
    if (moment[0] >= -allowed) return;
    const std::string message = fmt::format(
        "inertia of body '{}' about its centre of mass is indefinite: principal moments "
        "{:.5g}, {:.5g}, {:.5g} kg m^2",
        shown(body.name), moment[0], moment[1], moment[2]);
    if (is_at_rest)
      diagnostics_.warning(where, message, "no joint moves it: left out");
    else if (group.bodies.size() > 1 && is_definite(group.moments))
      diagnostics_.warning(where, message, "with the bodies fixed to it it is not: used as it is");
    else
      report_indefinite(body, where, message);
  }

  void report_indefinite(const Body& body, const SourceRange& where, const std::string& message) {
    if (triangle_ == support::Severity::kError && !body.lenient)
      return diagnostics_.error(where, message, hint_at_point(body));
    indefinite_.push_back(body.name);
    diagnostics_.warning(where, message, "no rigid body has it: used as it is");
  }

  static bool is_definite(const MassMoments& moments) {
    return symmetric_eigenvalues(central_inertia(moments))[0] >=
           -kMomentTolerance * largest_moment(moments.inertia);
  }

  std::string hint_at_point(const Body& body) const {
    return body.inertia_point == InertiaPoint::kOrigin ? "is it about the centre of mass, not the origin?"
                                                       : "";
  }

  /// One group per body that hangs on a moving joint, and one of all bodies fixed to the world.
  std::vector<Group> groups() const {
    std::vector<Group> result(1);
    std::vector<std::size_t> group_of(mechanism_.bodies.size());
    std::vector<Pose> pose_of(mechanism_.bodies.size());
    for (const JointIndex index : depth_first(mechanism_)) {
      const Joint& joint = mechanism_.joints[index.value];
      const std::size_t b = joint.child.value;
      if (joint.type == JointType::kFixed) {
        const Pose parent = joint.parent ? pose_of[joint.parent->value] : Pose{};
        group_of[b] = joint.parent ? group_of[joint.parent->value] : 0;
        const Numbers3 offset = product(parent.R, numbers(joint.placement.position));
        pose_of[b] = {sum(parent.origin, offset),
                      product(parent.R, rotation_from_rpy(numbers(joint.placement.rotation.rpy)))};
      } else {
        group_of[b] = result.size();
        result.emplace_back();
      }
      add(result[group_of[b]], b, pose_of[b]);
    }
    return result;
  }

  void add(Group& group, std::size_t b, const Pose& pose) const {
    const MassMoments m = moved(moments(mechanism_.bodies[b]), pose);
    group.bodies.push_back(b);
    group.lumped = group.lumped || mechanism_.bodies[b].lumped;
    group.moments.mass += m.mass;
    group.moments.first = sum(group.moments.first, m.first);
    group.moments.inertia = sum(group.moments.inertia, m.inertia);
  }

  void check_triangle(const Group& group) {
    if (group.bodies.empty()) return;
    const Numbers3 moment = symmetric_eigenvalues(central_inertia(group.moments));
    const double allowed = kMomentTolerance * largest_moment(group.moments.inertia);
    if (moment[0] < -allowed || moment[0] + moment[1] >= moment[2] - allowed) return;
    const Body& body = mechanism_.bodies[group.bodies.front()];
    const std::size_t others = group.bodies.size() - 1;
    const std::string with = others == 0   ? ""
                             : others == 1 ? " with the body fixed to it"
                                           : fmt::format(" with the {} bodies fixed to it", others);
    const std::string message = fmt::format(
        "no rigid body has the inertia of '{}'{}: principal moments {:.5g} + {:.5g} < {:.5g} kg m^2",
        shown(body.name), with, moment[0], moment[1], moment[2]);
    const SourceRange where = body.inertia_where.line == 0 ? body.where : body.inertia_where;
    const bool is_rounding = moment[2] - moment[0] - moment[1] <= kTriangleRounding * moment[2];
    const bool lenient = std::any_of(group.bodies.begin(), group.bodies.end(),
                                     [this](std::size_t b) { return mechanism_.bodies[b].lenient; });
    if (triangle_ == support::Severity::kError && !lenient && !is_rounding)
      diagnostics_.error(where, message, "inertia_kind = \"lumped\" takes it as it is");
    else
      diagnostics_.warning(where, message, "used as it is");
  }

  const Mechanism& mechanism_;
  Diagnostics& diagnostics_;
  support::Severity triangle_;
  std::vector<double> values_;
  std::vector<std::string> indefinite_;
};

}  // namespace

std::vector<std::string> check_inertias(const Mechanism& mechanism, Diagnostics& diagnostics,
                                        support::Severity triangle) {
  return InertiaCheck(mechanism, diagnostics, triangle).run();
}

}  // namespace jourdain::model
