// [[override]]: what an importing file changes of what it imports.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "model/read/input_numbers.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// The imported element that the table's `key` names, which is what it is ("body"); nothing after a diagnostic.
template <class Element>
Element* find_imported(TomlFile& file, const toml::node& node, const char* key,
                       std::vector<Element>& elements) {
  const toml::table& table = *node.as_table();
  const toml::node& name_node = *table.get(key);
  const SourceRange where = file.range(name_node.source());
  if (!name_node.is_string()) {
    file.error(where,
               fmt::format("'{}' of an override must be a string, not {}", key, type_in_words(name_node)));
    return nullptr;
  }
  const std::string name = file.text_or(table, key);
  const auto found =
      find_named(file, where, "an override names", key, name, elements, file.complete().structure);
  if (!found) return nullptr;
  Element& element = elements[*found];
  if (element.where.file > 0) return &element;
  file.error(where, fmt::format("{} '{}' is not imported", key, shown(name)),
             fmt::format("its own table is at {}", file.line_in_words(element.where)));
  return nullptr;
}

/// A coordinate whose motion is given now: where it started before says nothing any more, and an actuator that no
/// description asks for goes.
void prescribe(TomlFile& file, SourceRange where, Mechanism& mechanism, JointIndex joint, std::size_t c) {
  Coordinate& coordinate = mechanism.joints[joint.value].coordinates[c];
  coordinate.initial_position = coordinate.initial_velocity = 0.0;
  coordinate.position_where = coordinate.velocity_where = {};
  coordinate.range.reset();
  const auto drives = [&](const Actuator& actuator) {
    return actuator.joint == joint && actuator.coordinate == c;
  };
  for (const Actuator& actuator : mechanism.actuators)
    if (drives(actuator) && !actuator.implied)
      file.error(where,
                 fmt::format("coordinate '{}' is prescribed and actuated at once", shown(coordinate.name)),
                 "its actuator is declared at " + file.line_in_words(actuator.where));
  remove_actuators(mechanism, [&](const Actuator& actuator) { return drives(actuator) && actuator.implied; });
}

void override_joint(TomlFile& file, const toml::node& node, Mechanism& mechanism) {
  Joint* const joint = find_imported(file, node, "joint", mechanism.joints);
  if (!joint) return;
  std::vector<SourceRange> before;
  for (const Coordinate& coordinate : joint->coordinates) before.push_back(coordinate.motion_where);
  change_joint(file, *node.as_table(), file.range(node.source()), *joint);
  const JointIndex index(static_cast<std::size_t>(joint - mechanism.joints.data()));
  for (std::size_t c = 0; c < before.size(); ++c) {
    const SourceRange& now = joint->coordinates[c].motion_where;
    if (now.line != before[c].line || now.file != before[c].file) prescribe(file, now, mechanism, index, c);
  }
}

}  // namespace

void read_overrides(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for (const toml::node& node : section) {
    const toml::table& table = *node.as_table();
    const SourceRange where = file.range(node.source());
    if (table.contains("body") == table.contains("joint"))
      file.error(where, "an override needs either 'body' or 'joint'", "the name of what is imported");
    else if (table.contains("joint"))
      override_joint(file, node, mechanism);
    else if (Body* const body = find_imported(file, node, "body", mechanism.bodies))
      change_body(file, table, where, *body);
  }
}

}  // namespace jourdain::model
