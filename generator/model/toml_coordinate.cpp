// Scalar coordinates of joints: springs, dampers, friction, initial values, prescribed motion.
#include <fmt/format.h>

#include <cmath>

#include "model/taylor.hpp"
#include "model/toml_sections.hpp"

namespace jourdain::model {

namespace {

const Scope kTimeScope = {{"t", {.kind = Variable::Kind::kTime}}};

/// Motion must have finite first and second derivatives at the start, at the parameters' default values.
void check_motion(TomlFile& file, const TomlTable& table, const Expression& motion) {
  std::vector<Taylor<double>> parameters;
  for (const double value : file.values()) parameters.push_back({value, 0, 0});
  const Taylor<double> at_start = motion.evaluate<Taylor<double>>(
      parameters,
      [](double v) {
        return Taylor<double>{v, 0, 0};
      },
      [](const Variable&) {
        return Taylor<double>{0, 1, 0};
      });
  const char* what = !std::isfinite(at_start.value)    ? "value"
                     : !std::isfinite(at_start.first)  ? "velocity"
                     : !std::isfinite(at_start.second) ? "acceleration"
                                                       : nullptr;
  if (what)
    table.error("motion", fmt::format("the {} of {} is not finite at t = 0", what, table.quoted("motion")),
                "the motion must start smoothly");
}

}  // namespace

void read_coordinate(TomlFile& file, const TomlTable& table, Coordinate& coordinate) {
  coordinate.stiffness = table.number("stiffness");
  coordinate.rest = table.number("rest");
  coordinate.damping = table.number("damping");
  coordinate.friction = table.number("friction");
  if (table.has("friction") && file.value(coordinate.friction) < 0)
    table.error("friction", fmt::format("{} is negative", table.quoted("friction")));
  if (table.has("friction_speed")) coordinate.friction_speed = table.positive("friction_speed");
  coordinate.initial_position = table.number("initial_position");
  coordinate.initial_velocity = table.number("initial_velocity");
  if (!table.has("motion")) return;
  const std::size_t mark = file.error_count();
  coordinate.motion = table.function("motion", kTimeScope);
  coordinate.motion_where = table.where("motion");
  if (file.error_count() == mark) check_motion(file, table, *coordinate.motion);
  for (const char* key : {"initial_position", "initial_velocity"})
    if (table.has(key))
      table.error(key, fmt::format("{} has a prescribed motion and no '{}'", table.what(), key),
                  "the motion says where it starts");
}

const std::vector<std::string>& coordinate_keys() {
  static const std::vector<std::string> keys = {
      "stiffness",      "rest",   "damping",          "friction",
      "friction_speed", "motion", "initial_position", "initial_velocity"};
  return keys;
}

}  // namespace jourdain::model
