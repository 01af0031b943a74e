// [[actuator]]
#include <fmt/format.h>

#include <algorithm>

#include "model/read/input_numbers.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// The actuator of the mechanism that a new one on its coordinate takes the place of: one that no description asks for.
Actuator* implied_one(Mechanism& mechanism, const Actuator& actuator) {
  const auto found =
      std::find_if(mechanism.actuators.begin(), mechanism.actuators.end(), [&](const Actuator& other) {
        return other.implied && other.joint == actuator.joint && other.coordinate == actuator.coordinate;
      });
  return found == mechanism.actuators.end() ? nullptr : &*found;
}

std::optional<Actuator> read_actuator(TomlFile& file, const TomlTable& table,
                                      const std::vector<Joint>& joints) {
  const std::optional<std::string> joint_name = table.required_text("joint");
  if (!joint_name) return {};
  const auto joint =
      find_named(file, table.where("joint"), "an actuator names", "joint", *joint_name, joints, true);
  if (!joint) return {};
  const auto coordinate = find_coordinate(table, joints[*joint]);
  Actuator actuator;
  actuator.joint = JointIndex(*joint);
  actuator.coordinate = coordinate.value_or(0);
  actuator.name = coordinate ? joints[*joint].coordinates[*coordinate].name : *joint_name;
  if (const auto name = table.text("name")) actuator.name = *name;
  actuator.gear_ratio = table.number("gear_ratio", needed::kGearRatio, 1.0);
  actuator.rotor_inertia = table.number("rotor_inertia", needed::kRotorInertia);
  actuator.where = table.where(table.has("name") ? "name" : "joint");
  if (table.has("rotor_inertia") && file.value(actuator.rotor_inertia) < 0)
    table.error("rotor_inertia", fmt::format("{} is negative", table.quoted("rotor_inertia")));
  if (coordinate && joints[*joint].coordinates[*coordinate].motion)
    table.error("joint",
                fmt::format("coordinate '{}' is prescribed and actuated at once",
                            shown(joints[*joint].coordinates[*coordinate].name)),
                "an output of kind \"drive\" tells the force that the motion needs");
  if (table.has("name")) check_identifier(file, actuator.where, "actuator", actuator.name);
  return actuator;
}

}  // namespace

void read_actuators(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for (const toml::node& node : section) {
    const TomlTable table(file, *node.as_table(), "an actuator", file.range(node.source()),
                          keys_of("actuator"));
    const std::optional<Actuator> actuator = read_actuator(file, table, mechanism.joints);
    if (!actuator) continue;
    Actuator* const implied = implied_one(mechanism, *actuator);
    const bool keeps_name = implied && implied->name == actuator->name;
    const bool is_new =
        keeps_name || (is_new_name(file, actuator->where, "actuators", actuator->name, mechanism.actuators) &&
                       is_new_name(file, actuator->where, "inputs", actuator->name, mechanism.inputs));
    if (!is_new) continue;
    if (implied)
      *implied = *actuator;
    else
      add_actuator(mechanism, *actuator);
  }
}

}  // namespace jourdain::model
