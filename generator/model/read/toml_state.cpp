// [[state]] and [[signal]]
#include <fmt/format.h>

#include <cmath>

#include "model/expression_functions.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"
#include "model/read/toml_state.hpp"

namespace jourdain::model {

using support::shown;

bool check_signal_name(TomlFile& file, const TomlTable& table, const char* what, const std::string& name,
                       const Mechanism& mechanism) {
  const SourceRange where = table.where("name");
  check_identifier(file, where, what, name);
  if (is_expression_word(name) || name == time_scope().front().name) {
    table.error("name", fmt::format("{} '{}' would hide what '{}' means in expressions", what, name, name));
    return false;
  }
  for (const Joint& joint : mechanism.joints)
    for (const Coordinate& coordinate : joint.coordinates)
      if (coordinate.name == name) {
        table.error("name", fmt::format("{} '{}' has the name of a coordinate", what, shown(name)),
                    "declared at " + file.line_in_words(joint.where));
        return false;
      }
  const auto is_new = [&](const char* kinds, const auto& earlier) {
    return is_new_name(file, where, kinds, name, earlier);
  };
  return is_new("inputs, states or signals", mechanism.actuators) &&
         is_new("inputs, states or signals", mechanism.inputs) &&
         is_new("states or signals", mechanism.states) && is_new("states or signals", file.signals());
}

namespace {

std::string read_si_unit(const TomlTable& table, const char* what, const std::string& name) {
  const std::optional<Unit> unit = table.unit("unit");
  if (!table.has("unit") || !unit) return "";
  if (unit->factor != 1)
    table.error("unit", fmt::format("{} '{}' is in SI units", what, shown(name)),
                fmt::format("'{}', with the conversion in the expressions that use it", unit->si));
  return *table.text("unit");
}

/// All but its rate, whose expression may name states that are declared later.
std::optional<StateVariable> read_state(TomlFile& file, const TomlTable& table, const Mechanism& mechanism) {
  if (!table.has("rate")) table.missing("rate", "an expression of t, coordinates, inputs, frames and states");
  return read_state_variable(file, table, "state", mechanism);
}

/// An expression that later ones may name.
void read_signal(TomlFile& file, const toml::node& node, const Mechanism& mechanism) {
  const TomlTable table(file, *node.as_table(),
                        fmt::format("signal '{}'", shown(file.text_or(*node.as_table(), "name"))),
                        file.range(node.source()), keys_of("signal"));
  Signal signal;
  signal.name = table.required_text("name").value_or("");
  signal.where = table.where("name");
  signal.unit = read_si_unit(table, "signal", signal.name);
  if (!table.has("value"))
    table.missing("value", "an expression of t, coordinates, inputs, frames and states");
  const std::size_t mark = file.error_count();
  const auto read = [&] { return table.function("value", {{signal.unit}}, general_scope(file, mechanism)); };
  signal.value = read();
  if (file.error_count() == mark) {
    signal.smoothed_everywhere = file.with_smooth_callables(Callable::Smooth::kEverywhere, read);
    signal.smoothed_within_ends = file.with_smooth_callables(Callable::Smooth::kWithinEnds, read);
  }
  if (signal.name.empty() || !check_signal_name(file, table, "signal", signal.name, mechanism)) return;
  file.declare(std::move(signal));
}

}  // namespace

std::optional<StateVariable> read_state_variable(TomlFile& file, const TomlTable& table, const char* what,
                                                 const Mechanism& mechanism) {
  StateVariable state;
  state.name = table.required_text("name").value_or("");
  state.where = table.where("name");
  state.unit = read_si_unit(table, what, state.name);
  state.initial = table.number("initial", {{state.unit}});
  if (table.has("nominal"))
    state.nominal = table.positive("nominal", {{state.unit}});
  else if (const double size = std::fabs(file.value(state.initial)); size > 1)
    state.nominal = size;
  state.description = table.text("description").value_or("");
  if (state.name.empty() || !check_signal_name(file, table, what, state.name, mechanism)) return {};
  return state;
}

void read_states(TomlFile& file, const StateTables& tables, Mechanism& mechanism) {
  struct Read {
    TomlTable table;
    std::optional<std::size_t> index;  // in the mechanism
  };
  std::vector<Read> read;
  for (const toml::node& node : tables.states) {
    const TomlTable table(file, *node.as_table(),
                          fmt::format("state '{}'", shown(file.text_or(*node.as_table(), "name"))),
                          file.range(node.source()), keys_of("state"));
    std::optional<StateVariable> state = read_state(file, table, mechanism);
    read.push_back({table, {}});
    if (!state) continue;
    read.back().index = mechanism.states.size();
    mechanism.states.push_back(std::move(*state));
  }
  Memories memories(file, tables.memories, mechanism);
  for (const toml::node& node : tables.signals) read_signal(file, node, mechanism);
  const Scope scope = general_scope(file, mechanism);
  auto item = read.begin();
  for ([[maybe_unused]] const toml::node& node : tables.states) {  // with the index of its repetition
    const auto& [table, index] = *item++;
    if (!index) continue;
    const std::string unit = unit_per_second(mechanism.states[*index].unit);
    const Expression rate = table.function("rate", {{unit}}, scope);
    mechanism.states[*index].rate = settled(rate, mechanism);
  }
  memories.read_updates(scope);
}

}  // namespace jourdain::model
