// Scenario files.
#include <fmt/format.h>

#include "model/read/scenario.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_sections.hpp"
#include "model/read/toml_table.hpp"

namespace jourdain::model {

namespace {

/// One expression of t per name; zero where it is left out. `needs`: by name.
std::vector<Expression> expressions(const TomlTable& table, const std::vector<std::string>& names,
                                    const std::vector<Needed>& needs) {
  std::vector<Expression> result;
  for (std::size_t i = 0; i < names.size(); ++i)
    result.push_back(table.function(names[i], needs[i], time_scope()));
  return result;
}

/// In the order of CoordinateLayout's inputs.
std::vector<Needed> needs_of_inputs(const Mechanism& mechanism) {
  std::vector<Needed> needs;
  for (const Actuator& actuator : mechanism.actuators) needs.push_back(input_needs(mechanism, actuator));
  for (const Input& input : mechanism.inputs) needs.push_back(input_needs(input));
  return needs;
}

/// In the order of the positions of a mechanism without quaternions.
std::vector<Needed> needs_of_positions(const Mechanism& mechanism, const CoordinateLayout& layout) {
  std::vector<Needed> needs(layout.position_count());
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
      if (const auto entry = layout.joints[j].position[c])
        needs[*entry] = coordinate_needs(mechanism.joints[j], c).position;
  return needs;
}

bool is_actuated(const Mechanism& mechanism, const CoordinateLayout& layout, std::size_t entry) {
  for (const Actuator& actuator : mechanism.actuators)
    if (layout.joints[actuator.joint.value].velocity[actuator.coordinate] == entry) return true;
  return false;
}

std::vector<Expression> read_follow(TomlFile& file, const TomlTable& table, const Mechanism& mechanism,
                                    const CoordinateLayout& layout) {
  if (!layout.quaternions.empty()) {
    table.error("", "a mechanism with quaternions cannot follow a motion", "drive it with [input]");
    return {};
  }
  if (!mechanism.loops.empty()) {
    table.error("", "a mechanism with closed loops cannot follow a motion", "drive it with [input]");
    return {};
  }
  if (!mechanism.states.empty()) {
    table.error("", "a mechanism with states cannot follow a motion", "drive it with [input]");
    return {};
  }
  for (std::size_t i = 0; i < layout.velocity_count(); ++i) {
    const std::string& name = layout.position_names[i];
    if (!table.has(name))
      table.missing(name, "every coordinate needs a motion");
    else if (!is_actuated(mechanism, layout, i))
      table.error(name, fmt::format("coordinate '{}' has no actuator", name),
                  "inverse dynamics needs one for each");
  }
  const std::vector<Needed> needs = needs_of_positions(mechanism, layout);
  const std::size_t errors = file.error_count();
  std::vector<Expression> motions = expressions(table, layout.position_names, needs);
  for (std::size_t i = 0; i < needs.size() && file.error_count() == errors; ++i)
    refuse_kinks(file, table, layout.position_names[i],
                 [&] { return table.function(layout.position_names[i], needs[i], time_scope()); });
  return motions;
}

Scenario read_root(TomlFile& file, const toml::table& root, const Mechanism& mechanism) {
  const CoordinateLayout layout = lay_out_coordinates(mechanism);
  const TomlTable top(file, root, "the file", {}, {"input", "follow"});
  Scenario scenario;
  if (top.has("input") == top.has("follow")) {
    file.error({}, "the file must have [input] or [follow], and not both");
    return scenario;
  }
  if (const toml::table* section = top.has("input") ? top.table("input") : nullptr) {
    const TomlTable table(file, *section, "[input]", top.where("input"), layout.input_names);
    scenario.inputs = expressions(table, layout.input_names, needs_of_inputs(mechanism));
  }
  if (const toml::table* section = top.has("follow") ? top.table("follow") : nullptr) {
    const TomlTable table(file, *section, "[follow]", top.where("follow"), layout.position_names);
    scenario.follow = read_follow(file, table, mechanism, layout);
  }
  return scenario;
}

}  // namespace

std::optional<Scenario> read_scenario(support::Diagnostics& diagnostics, const Mechanism& mechanism) {
  const std::optional<toml::table> root = parse_toml(diagnostics);
  if (!root) return {};
  TomlFile file(diagnostics);
  file.declare(mechanism);
  Scenario scenario = read_root(file, *root, mechanism);
  if (file.error_count() > 0) return {};
  return scenario;
}

}  // namespace jourdain::model
