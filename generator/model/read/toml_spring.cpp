// [[spring]]
#include <fmt/format.h>

#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// Of a spring's length, and of its rate too where that is asked for.
Scope spring_scope(bool with_rate) {
  Scope scope = {{"length", {.kind = Variable::Kind::kArgument}, Measure::variable(needed::kLength)}};
  if (with_rate)
    scope.push_back(
        {"rate", {.kind = Variable::Kind::kArgument, .component = 1}, Measure::variable(needed::kSpeed)});
  return scope;
}

}  // namespace

void read_springs(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  std::size_t number = 0;
  for (const toml::node& node : section) {
    Spring spring;
    spring.name = name_or_number(file, *node.as_table(), "spring", ++number);
    const TomlTable table(file, *node.as_table(), fmt::format("spring '{}'", shown(spring.name)),
                          file.range(node.source()), keys_of("spring"));
    const auto ends = find_ends(file, table, mechanism);
    spring.where = table.where("from");
    spring.stiffness = table.number("stiffness", needed::kStiffness);
    spring.damping = table.number("damping", needed::kDamping);
    spring.free_length = table.number("free_length", needed::kLength);
    spring.law = table.function("law", needed::kForce, spring_scope(true));
    if (table.has("potential"))
      spring.potential = table.function("potential", needed::kEnergy, spring_scope(false));
    if (!ends) continue;
    spring.from = ends->first;
    spring.to = ends->second;
    mechanism.springs.push_back(spring);
  }
}

}  // namespace jourdain::model
