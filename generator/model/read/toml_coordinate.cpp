// Scalar coordinates of joints: springs, dampers, friction, initial values, range, prescribed motion.
#include <fmt/format.h>

#include <cmath>

#include "model/expression_taylor.hpp"
#include "model/hidden_kinks.hpp"
#include "model/joint_kinds.hpp"
#include "model/motion_sources.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

/// "velocity", the first one that is not, or nothing; nothing of states and functions that are not known yet.
const char* not_finite_at_start(const TomlFile& file, const Expression& function) {
  if (function.calls(support::Function::kCall) || !states_in(function).empty()) return nullptr;
  const auto at_start = taylor_of<double>(function, file.values(), [](const Variable&) {
    return Taylor<double>{0, 1, 0};
  });
  return !std::isfinite(at_start.value)    ? "value"
         : !std::isfinite(at_start.first)  ? "velocity"
         : !std::isfinite(at_start.second) ? "acceleration"
                                           : nullptr;
}

/// The initial position must lie in the range, at the parameters' default values.
void read_range(TomlFile& file, const TomlTable& table, const Needed& position, Coordinate& coordinate) {
  const std::size_t mark = file.error_count();
  const std::optional<std::array<double, 2>> given = table.constant_pair("range", position, {});
  if (coordinate.motion && table.has("range"))
    table.error("range", fmt::format("{} has a prescribed motion and no 'range'", table.what()),
                "the motion says where it goes");
  if (given) {
    coordinate.range = given;
    coordinate.range_is_limit = false;
  }
  const char* const key = given ? "range" : "initial_position";
  if (!coordinate.range || coordinate.range_is_limit || !table.has(key) || file.error_count() != mark) return;
  const auto [least, greatest] = *coordinate.range;
  const double start = file.value(coordinate.initial_position);
  if (!(least < greatest))
    table.error("range",
                fmt::format("{} is empty: {} is not below {}", table.quoted("range"), least, greatest),
                "write the smaller number first");
  else if (!(least <= start && start <= greatest))
    table.error(key, fmt::format("{} starts at {}, outside its range from {} to {}", table.what(), start,
                                 least, greatest));
}

}  // namespace

CoordinateNeeds coordinate_needs(const Joint& joint, std::size_t coordinate) {
  if (joint_kind(joint).motions[coordinate].kind == MotionKind::kCurve) return {};
  if (joint.coordinates[coordinate].angular)
    return {needed::kAngle, needed::kAngularRate, needed::kMoment, needed::kAngularStiffness,
            needed::kAngularDamping};
  return {needed::kLength, needed::kSpeed, needed::kForce, needed::kStiffness, needed::kDamping};
}

CoordinateNeeds coordinate_needs(const Mechanism& mechanism, const std::optional<ScalarCoordinate>& at) {
  return at ? coordinate_needs(mechanism.joints[at->joint.value], at->coordinate) : CoordinateNeeds{};
}

std::optional<ScalarCoordinate> find_coordinate(TomlFile& file, const TomlTable& table,
                                                const Mechanism& mechanism) {
  const std::optional<std::string> name = table.required_text("joint");
  if (!name) return {};
  const auto joint = find_named(file, table.where("joint"), table.what() + " names", "joint", *name,
                                mechanism.joints, file.complete().structure);
  if (!joint) return {};
  const auto coordinate = find_coordinate(table, mechanism.joints[*joint]);
  if (!coordinate) return {};
  return ScalarCoordinate{JointIndex(*joint), *coordinate};
}

const Scope& time_scope() {
  static const Scope scope = {{"t", {.kind = Variable::Kind::kTime}, Measure::time()}};
  return scope;
}

void refuse_calls(const TomlTable& table, std::string_view key, const Expression& function) {
  if (function.calls(support::Function::kCall))
    table.error(key, fmt::format("{} calls an external function", table.quoted(key)),
                "it is differentiated here: forces, rates of states and outputs may");
}

Kinks kinks_of(TomlFile& file, const std::function<Expression()>& read) {
  using Smooth = Callable::Smooth;
  if (!file.with_smooth_callables(Smooth::kEverywhere, read).has_kinks()) return Kinks::kNone;
  const bool within = file.with_smooth_callables(Smooth::kWithinEnds, read).has_kinks();
  return within ? Kinks::kAnywhere : Kinks::kWhereTablesEnd;
}

void refuse_kinks(TomlFile& file, const TomlTable& table, std::string_view key,
                  const std::function<Expression()>& read) {
  const Kinks kinks = kinks_of(file, read);
  if (kinks == Kinks::kWhereTablesEnd)
    table.error(key,
                fmt::format("{} has a kink where a table ends, where velocities jump", table.quoted(key)),
                "a curve may go on beyond its ends: beyond = \"extend\", or \"repeat\"");
  if (kinks == Kinks::kAnywhere)
    table.error(key,
                fmt::format("{} may have a kink, where velocities or accelerations jump", table.quoted(key)),
                "it is differentiated twice; smooth_step, smooth_max, tanh and splines have none");
  if (kinks == Kinks::kNone) refuse_hidden_kinks(file, table, key, read());
}

void refuse_hidden_kinks(TomlFile& file, const TomlTable& table, std::string_view key,
                         const Expression& function) {
  if (const std::optional<HiddenKink> kink = hidden_kink(function, file.values()))
    table.error(key,
                fmt::format("{} may have a kink or a pole, where velocities or accelerations jump: {}",
                            table.quoted(key), in_words(*kink)),
                hint_of(*kink));
}

Expression read_time_function(TomlFile& file, const TomlTable& table, std::string_view key,
                              const Needed& needed, const Scope& scope) {
  const std::size_t mark = file.error_count();
  const auto read = [&] { return table.function(key, needed, scope); };
  Expression function = read();
  if (file.error_count() != mark) return function;
  const char* const what = not_finite_at_start(file, function);
  if (what)
    table.error(key, fmt::format("the {} of {} is not finite at t = 0", what, table.quoted(key)),
                fmt::format("the {} must start smoothly", key));
  else
    refuse_kinks(file, table, key, read);
  return function;
}

void read_coordinate(TomlFile& file, const TomlTable& table, const CoordinateNeeds& needs,
                     Coordinate& coordinate) {
  coordinate.stiffness = table.number("stiffness", needs.stiffness, coordinate.stiffness);
  coordinate.rest = table.number("rest", needs.position, coordinate.rest);
  coordinate.damping = table.number("damping", needs.damping, coordinate.damping);
  coordinate.friction = table.number("friction", needs.force, coordinate.friction);
  if (table.has("friction") && file.value(coordinate.friction) < 0)
    table.error("friction", fmt::format("{} is negative", table.quoted("friction")));
  if (table.has("friction_speed")) coordinate.friction_speed = table.positive("friction_speed", needs.rate);
  coordinate.initial_position = table.number("initial_position", needs.position, coordinate.initial_position);
  coordinate.initial_velocity = table.number("initial_velocity", needs.rate, coordinate.initial_velocity);
  if (table.has("initial_position")) coordinate.position_where = table.where("initial_position");
  if (table.has("initial_velocity")) coordinate.velocity_where = table.where("initial_velocity");
  if (table.has("motion"))
    coordinate.motion = read_time_function(file, table, "motion", needs.position, file.motion_scope());
  read_range(file, table, needs.position, coordinate);
  if (!coordinate.motion) return;
  if (table.has("motion")) coordinate.motion_where = table.where("motion");
  for (const char* key : {"initial_position", "initial_velocity"})
    if (table.has(key))
      table.error(key, fmt::format("{} has a prescribed motion and no '{}'", table.what(), key),
                  "the motion says where it starts");
}

}  // namespace jourdain::model
