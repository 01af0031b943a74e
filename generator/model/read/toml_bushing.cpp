// [[bushing]]
#include <fmt/format.h>

#include <algorithm>

#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

/// None negative at the parameters' default values.
Vector3 read_damping(TomlFile& file, const TomlTable& table, std::string_view key, const Needed& needed) {
  Vector3 damping = table.vector(key, needed);
  if (std::any_of(damping.begin(), damping.end(), [&](const Expression& c) { return file.value(c) < 0; }))
    table.error(key, fmt::format("{} of {} is negative", key, table.what()), "it would feed the motion");
  return damping;
}

}  // namespace

void read_bushings(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  std::size_t number = 0;
  for (const toml::node& node : section) {
    Bushing bushing;
    bushing.name = name_or_number(file, *node.as_table(), "bushing", ++number);
    const TomlTable table(file, *node.as_table(), fmt::format("bushing '{}'", support::shown(bushing.name)),
                          file.range(node.source()), keys_of("bushing"));
    const auto ends = find_ends(file, table, mechanism);
    bushing.where = table.where("from");
    bushing.stiffness = table.vector("stiffness", needed::kStiffness);
    bushing.damping = read_damping(file, table, "damping", needed::kDamping);
    bushing.torsional_stiffness = table.vector("torsional_stiffness", needed::kAngularStiffness);
    bushing.torsional_damping = read_damping(file, table, "torsional_damping", needed::kAngularDamping);
    if (!ends) continue;
    bushing.from = ends->first;
    bushing.to = ends->second;
    mechanism.bushings.push_back(bushing);
  }
}

}  // namespace jourdain::model
