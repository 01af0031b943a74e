// [[force]]
#include <fmt/format.h>

#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

void read_load(TomlFile& file, const TomlTable& table, const std::string& name, const Scope& scope,
               Mechanism& mechanism) {
  const auto frame = find_frame(file, table, "frame", mechanism);
  if (!table.has("force") && !table.has("moment"))
    table.missing("force", "or a moment, or both: three expressions each");
  Load load;
  load.name = name;
  load.where = table.where("frame");
  load.axes = static_cast<LoadAxes>(table.choice("axes", {"frame", "world"}).value_or(0));
  load.force = table.functions("force", needed::kForce, scope);
  load.moment = table.functions("moment", needed::kMoment, scope);
  if (!frame) return;
  if (!mechanism.frames[frame->value].body)
    table.error("frame", fmt::format("{} acts on the world, which cannot move", table.what()));
  for (std::size_t k = 0; k < 3; ++k) {
    load.force[k] = settled(load.force[k], mechanism);
    load.moment[k] = settled(load.moment[k], mechanism);
  }
  load.frame = *frame;
  mechanism.loads.push_back(load);
}

void read_coordinate_force(TomlFile& file, const TomlTable& table, const std::string& name,
                           const Scope& scope, Mechanism& mechanism) {
  for (const char* key : {"force", "moment", "axes"})
    if (table.has(key))
      table.error(key, fmt::format("{} acts on a joint and has no '{}'", table.what(), key),
                  "write value = \"...\"");
  if (!table.has("value")) table.missing("value", "an expression, N m or N");
  const std::optional<ScalarCoordinate> found = find_coordinate(file, table, mechanism);
  const Needed needed = coordinate_needs(mechanism, found).force;
  CoordinateForce force;
  force.name = name;
  force.where = table.where("joint");
  force.force = settled(table.function("value", needed, scope), mechanism);
  if (!found) return;
  force.joint = found->joint;
  force.coordinate = found->coordinate;
  mechanism.coordinate_forces.push_back(force);
}

}  // namespace

void read_forces(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  const Scope scope = general_scope(file, mechanism);
  std::size_t number = 0;
  for (const toml::node& node : section) {
    const std::string name = name_or_number(file, *node.as_table(), "force", ++number);
    const TomlTable table(file, *node.as_table(), fmt::format("force '{}'", shown(name)),
                          file.range(node.source()), keys_of("force"));
    if (table.has("frame") == table.has("joint"))
      file.error(file.range(node.source()),
                 fmt::format("force '{}' needs either 'frame' or 'joint'", shown(name)));
    else if (table.has("frame"))
      read_load(file, table, name, scope, mechanism);
    else
      read_coordinate_force(file, table, name, scope, mechanism);
  }
}

}  // namespace jourdain::model
