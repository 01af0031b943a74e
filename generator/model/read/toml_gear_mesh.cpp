// [[gear_mesh]]: elastic teeth of two wheels, made of expressions.
#include <fmt/format.h>

#include <optional>
#include <utility>

#include "model/expression_sums.hpp"
#include "model/read/pushing.hpp"
#include "model/read/toml_coordinate_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// Teeth of two wheels against each other: e = r1 q1 + r2 q2 along the line of action, which a backlash b lets be
/// between −b/2 and b/2. F = k (e ∓ b/2) + c e′ beyond, and never pulls.
class GearMeshReader {
 public:
  GearMeshReader(TomlFile& file, const TomlTable& table, std::string name, Mechanism& mechanism)
      : file_(file), table_(table), name_(std::move(name)), mechanism_(mechanism) {}

  void read() {
    const auto first = wheel("first"), second = wheel("second");
    const Expression stiffness = table_.positive("stiffness", needed::kStiffness),
                     damping = table_.not_negative("damping", needed::kDamping),
                     backlash = table_.not_negative("backlash", needed::kLength);
    const Expression radius1 = radius("first_radius"), radius2 = radius("second_radius");
    if (!first || !second) return;
    if (first->joint == second->joint && first->coordinate == second->coordinate)
      return table_.error("second", fmt::format("{} meshes a wheel with itself", table_.what()));
    const Expression e = plus(times(radius1, position(*first)), times(radius2, position(*second))),
                     rate = plus(times(radius1, speed(*first)), times(radius2, speed(*second)));
    const Expression force = tooth_force(e, rate, stiffness, damping, backlash);
    for (const auto& [at, arm] : {std::pair(*first, radius1), {*second, radius2}}) {
      CoordinateForce torque;
      torque.name = name_;
      torque.where = table_.where("first");
      torque.joint = at.joint;
      torque.coordinate = at.coordinate;
      torque.force = minus(0.0, times(arm, force));
      mechanism_.coordinate_forces.push_back(torque);
    }
  }

 private:
  static Expression position(const ScalarCoordinate& at) {
    return Expression::variable({Variable::Kind::kPosition, at.joint.value, at.coordinate});
  }
  static Expression speed(const ScalarCoordinate& at) {
    return Expression::variable({Variable::Kind::kVelocity, at.joint.value, at.coordinate});
  }

  static Expression tooth_force(const Expression& e, const Expression& rate, const Expression& stiffness,
                                const Expression& damping, const Expression& backlash) {
    const Expression damped = times(damping, rate);
    if (backlash.is_zero()) return plus(times(stiffness, e), damped);
    const Expression half = times(0.5, backlash), ahead = minus(e, half), behind = minus(minus(0.0, e), half);
    return minus(pushing(ahead, plus(times(stiffness, ahead), damped)),
                 pushing(behind, minus(times(stiffness, behind), damped)));
  }

  /// Of the base circle; negative of one inside a ring.
  Expression radius(const char* key) {
    if (!table_.has(key)) table_.missing(key, "of the base circle; of a ring's wheel negative");
    Expression value = table_.number(key, needed::kLength);
    if (table_.has(key) && file_.value(value) == 0)
      table_.error(key, fmt::format("{} is zero", table_.quoted(key)));
    return value;
  }

  std::optional<ScalarCoordinate> wheel(const char* key) {
    const std::optional<std::string> name = table_.required_text(key);
    if (!name) return {};
    const auto found = find_scalar(file_, table_.where(key), table_.what() + " names", *name, mechanism_);
    if (!found || mechanism_.joints[found->joint.value].coordinates[found->coordinate].angular) return found;
    table_.error(key, fmt::format("'{}' is no angle", shown(*name)), "wheels turn");
    return {};
  }

  TomlFile& file_;
  const TomlTable& table_;
  std::string name_;
  Mechanism& mechanism_;
};

}  // namespace

void read_gear_meshes(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for_each_table(file, section, "gear_mesh", [&](const TomlTable& table, const std::string& name) {
    GearMeshReader(file, table, name, mechanism).read();
  });
}

}  // namespace jourdain::model
