// [[stop]]: elastic ends of a coordinate's way, made of expressions.
#include "model/expression_sums.hpp"
#include "model/read/pushing.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

/// max(k d + c d′, 0) at a depth d > 0 beyond each limit (Kelvin and Voigt).
void read_stop(TomlFile& file, const TomlTable& table, const std::string& name, Mechanism& mechanism) {
  const std::optional<std::string> joint_name = table.required_text("joint");
  if (!joint_name) return;
  const auto joint = find_named(file, table.where("joint"), table.what() + " names", "joint", *joint_name,
                                mechanism.joints, file.complete().structure);
  const std::size_t j = joint.value_or(0);
  std::size_t c = 0;
  bool is_found = false;
  if (joint)
    if (const auto coordinate = find_coordinate(table, mechanism.joints[j])) {
      c = *coordinate;
      is_found = true;
    }
  const CoordinateNeeds needs = is_found ? coordinate_needs(mechanism.joints[j], c) : CoordinateNeeds{};
  const Expression stiffness = table.positive("stiffness", needs.stiffness);
  const Expression damping = table.number("damping", needs.damping);
  refuse_negative(file, table, "damping", damping);
  const Expression lower = table.number("lower", needs.position),
                   upper = table.number("upper", needs.position);
  const bool has_lower = table.has("lower"), has_upper = table.has("upper");
  if (!has_lower && !has_upper) table.missing("upper", "or 'lower', or both");
  if (has_lower && has_upper && !(file.value(lower) < file.value(upper)))
    table.error("upper", fmt::format("{} is not above 'lower'", table.quoted("upper")));
  if (!is_found) return;
  const Expression at = Expression::variable({Variable::Kind::kPosition, j, c}),
                   rate = Expression::variable({Variable::Kind::kVelocity, j, c});
  const auto force = [&](const Expression& depth, const Expression& speed) {
    return pushing(depth, plus(times(stiffness, depth), times(damping, speed)));
  };
  CoordinateForce stop;
  stop.name = name;
  stop.where = table.where("joint");
  stop.joint = JointIndex(j);
  stop.coordinate = c;
  if (has_lower) stop.force = force(minus(lower, at), Expression::unary(Expression::Op::kNegate, rate));
  if (has_upper) stop.force = minus(stop.force, force(minus(at, upper), rate));
  mechanism.coordinate_forces.push_back(stop);
}

}  // namespace

void read_stops(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for_each_table(file, section, "stop", [&](const TomlTable& table, const std::string& name) {
    read_stop(file, table, name, mechanism);
  });
}

}  // namespace jourdain::model
