// [[stop]]: elastic ends of a coordinate's way, made of expressions.
#include "model/expression_sums.hpp"
#include "model/read/pushing.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

/// max(k d + c d′, 0) at a depth d > 0 beyond each limit (Kelvin and Voigt).
void read_stop(TomlFile& file, const TomlTable& table, const std::string& name, Mechanism& mechanism) {
  if (!table.required_text("joint")) return;
  const std::optional<ScalarCoordinate> found = find_coordinate(file, table, mechanism);
  const CoordinateNeeds needs = coordinate_needs(mechanism, found);
  const Expression stiffness = table.positive("stiffness", needs.stiffness);
  const Expression damping = table.not_negative("damping", needs.damping);
  const Expression lower = table.number("lower", needs.position),
                   upper = table.number("upper", needs.position);
  const bool has_lower = table.has("lower"), has_upper = table.has("upper");
  if (!has_lower && !has_upper) table.missing("upper", "or 'lower', or both");
  if (has_lower && has_upper && !(file.value(lower) < file.value(upper)))
    table.error("upper", fmt::format("{} is not above 'lower'", table.quoted("upper")));
  if (!found) return;
  const auto& [joint, coordinate] = *found;
  const Expression at = Expression::variable({Variable::Kind::kPosition, joint.value, coordinate}),
                   rate = Expression::variable({Variable::Kind::kVelocity, joint.value, coordinate});
  const auto force = [&](const Expression& depth, const Expression& speed) {
    return pushing(depth, plus(times(stiffness, depth), times(damping, speed)));
  };
  CoordinateForce stop;
  stop.name = name;
  stop.where = table.where("joint");
  stop.joint = joint;
  stop.coordinate = coordinate;
  if (has_lower) stop.force = force(minus(lower, at), Expression::unary(Expression::Op::kNegate, rate));
  if (has_upper) stop.force = minus(stop.force, force(minus(at, upper), rate));
  const Expression below = minus(lower, at), above = minus(at, upper);
  const Expression depth = !has_upper   ? below
                           : !has_lower ? above
                                        : Expression::function(support::Function::kMax, below, above);
  stop.touch = {depth, stiffness, 1};
  mechanism.coordinate_forces.push_back(stop);
}

}  // namespace

void read_stops(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for_each_table(file, section, "stop", [&](const TomlTable& table, const std::string& name) {
    read_stop(file, table, name, mechanism);
  });
}

}  // namespace jourdain::model
