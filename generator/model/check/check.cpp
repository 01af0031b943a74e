// The whole check, and what can be said about single numbers.
#include <fmt/format.h>

#include <cmath>

#include "model/check/checks.hpp"
#include "model/joint_kinds.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;

SourceRange first_known(const SourceRange& wanted, const SourceRange& otherwise) {
  return wanted.line == 0 ? otherwise : wanted;
}

class NumberCheck {
 public:
  NumberCheck(const Mechanism& mechanism, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), values_(default_values(mechanism)) {}

  /// The value at the parameters' defaults; a diagnostic if it is not finite.
  double value(const Expression& expression, const SourceRange& where, const std::string& what) {
    const auto result = expression.evaluate<double>(values_);
    if (!std::isfinite(result))
      diagnostics_.error(where, fmt::format("{} is {} at the parameters' values", what,
                                            std::isnan(result) ? "not a number" : "infinite"));
    return result;
  }

  void values(const Vector3& vector, const SourceRange& where, const std::string& what) {
    for (const Expression& expression : vector) value(expression, where, what);
  }

  void body(const Body& body) {
    const std::string name = fmt::format("of body '{}'", support::shown(body.name));
    const SourceRange mass_where = first_known(body.mass_where, body.where);
    const double mass = value(body.mass, mass_where, "mass " + name);
    if (mass < 0) diagnostics_.error(mass_where, fmt::format("mass {} is negative: {} kg", name, mass));
    values(body.center_of_mass, body.where, "center_of_mass " + name);
    const SourceRange inertia_where = first_known(body.inertia_where, body.where);
    const Inertia& I = body.inertia;
    values({I.xx, I.yy, I.zz}, inertia_where, "inertia " + name);
    values({I.xy, I.xz, I.yz}, inertia_where, "inertia " + name);
    values(body.inertia_axes.rpy, first_known(body.inertia_axes.where, body.where), "inertia_rpy " + name);
  }

  void joint(const Joint& joint) {
    const std::string name = fmt::format("of joint '{}'", support::shown(joint.name));
    values(joint.placement.position, joint.where, "position " + name);
    values(joint.placement.rotation.rpy, first_known(joint.placement.rotation.where, joint.where),
           "rpy " + name);
    for (const Coordinate& c : joint.coordinates) {
      values({c.stiffness, c.rest, c.damping}, joint.where, "stiffness, rest or damping " + name);
      values({c.initial_position, c.initial_velocity, Expression(0.0)}, joint.where, "initial state " + name);
    }
    const JointKind& kind = joint_kind(joint);
    if (kind.has_origin()) check_free(joint);
    if (!kind.has_axis()) return;
    const SourceRange where = first_known(joint.axis_where, joint.where);
    const double length = std::hypot(joint.axis[0], joint.axis[1], joint.axis[2]);
    if (!std::isfinite(length)) diagnostics_.error(where, fmt::format("axis {} is not finite", name));
    if (length == 0)
      diagnostics_.error(where, fmt::format("axis {} is zero", name),
                         "an axis is a direction, such as [0, 0, 1]");
    if (kind.has(Along::kSecondAxis)) check_second_axis(joint, where, name);
  }

 private:
  void check_free(const Joint& joint) {
    bool placed = false;
    for (std::size_t k = 0; k < 3; ++k)
      placed = placed || !joint.placement.position[k].is_zero() || !joint.placement.rotation.rpy[k].is_zero();
    if (!joint.parent && !placed) return;
    diagnostics_.error(
        joint.where,
        fmt::format("free joint '{}' {}", support::shown(joint.name),
                    joint.parent ? "has a body as its parent" : "is placed away from the inertial frame"),
        joint.parent ? "its parent must be the world" : "its coordinates say where it is");
  }

  void check_second_axis(const Joint& joint, const SourceRange& where, const std::string& name) {
    const std::array<double, 3>&a = joint.axis, &b = joint.second_axis;
    const double cross =
        std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    const double size = std::hypot(a[0], a[1], a[2]) * std::hypot(b[0], b[1], b[2]);
    if (!(cross > 1e-6 * size))
      diagnostics_.error(where, fmt::format("the axes {} are parallel", name),
                         "second_axis must have another direction");
  }

  Diagnostics& diagnostics_;
  std::vector<double> values_;
};

}  // namespace

void check_numbers(const Mechanism& mechanism, Diagnostics& diagnostics) {
  NumberCheck check(mechanism, diagnostics);
  check.values(mechanism.gravity, {}, "gravity");
  for (const Body& body : mechanism.bodies) check.body(body);
  for (const Joint& joint : mechanism.joints) check.joint(joint);
  for (const StateVariable& state : mechanism.states)
    check.value(state.initial, state.where, fmt::format("initial of state '{}'", support::shown(state.name)));
}

void check_mechanism(const Mechanism& mechanism, Diagnostics& diagnostics, support::Severity triangle) {
  check_numbers(mechanism, diagnostics);
  if (!check_graph(mechanism, diagnostics)) return;
  check_motions(mechanism, diagnostics);
  check_loops(mechanism, diagnostics);
  check_inertias(mechanism, diagnostics, triangle);
}

}  // namespace jourdain::model
