// What prescribed motions may name: time and states, of which those of this file are declared later.
#include <variant>

#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

/// States that this file declares stand behind all others until they are read.
constexpr std::size_t kDeclared = 1'000'000;

std::string unit_of(TomlFile& file, const toml::table& table) {
  std::string unit = file.text_or(table, "unit");
  return std::holds_alternative<Unit>(parse_unit(unit)) ? unit : "";  // a diagnostic follows where it is read
}

void refuse(TomlFile& file, const TomlTables& section, std::string_view reason, Scope& scope) {
  for (const toml::node& node : section)
    scope.push_back({file.text_or(*node.as_table(), "name"), {}, Measure::open(), reason});
}

}  // namespace

void declare_motion_scope(TomlFile& file, const StateTables& tables, const TomlTables& inputs,
                          const Mechanism& mechanism) {
  Scope scope = time_scope();
  const auto add = [&scope](const std::string& name, std::size_t index, const std::string& unit) {
    scope.push_back({name, {Variable::Kind::kState, index}, Measure::variable({{unit}})});
  };
  for (std::size_t i = 0; i < mechanism.states.size(); ++i)
    add(mechanism.states[i].name, i, mechanism.states[i].unit);
  std::size_t index = kDeclared;
  for (const toml::node& node : tables.states) {
    const toml::table& table = *node.as_table();
    add(file.text_or(table, "name"), index++, unit_of(file, table));
  }
  refuse(file, tables.memories, "it jumps where it is sampled: a motion follows a state that follows it",
         scope);
  refuse(file, tables.signals, "a motion names states themselves", scope);
  refuse(file, inputs, "it may jump: a motion follows a state whose rate has a rate that follows it", scope);
  std::erase_if(scope, [](const ScopeEntry& entry) { return entry.name.empty(); });
  file.declare(std::move(scope));
}

void settle_motions(const TomlFile& file, Mechanism& mechanism) {
  const auto settled = [&](const Variable& variable) -> Expression {
    if (variable.kind != Variable::Kind::kState || variable.index < kDeclared)
      return Expression::variable(variable);
    for (const ScopeEntry& entry : file.motion_scope())
      if (entry.variable == variable)
        for (std::size_t i = 0; i < mechanism.states.size(); ++i)
          if (mechanism.states[i].name == entry.name)
            return Expression::variable({Variable::Kind::kState, i});
    return 0.0;  // it could not be read
  };
  for (Joint& joint : mechanism.joints)
    for (Coordinate& coordinate : joint.coordinates)
      if (coordinate.motion) coordinate.motion = coordinate.motion->substituted(settled);
}

}  // namespace jourdain::model
