#include "commands/signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace jourdain::commands {

namespace {

/// Does `text` match `pattern`, in which '*' stands for any characters?
bool matches(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p, ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

}  // namespace

Signals::Signals(const LoadedMechanism& loaded, const std::vector<programs::OutputFacts>& outputs) {
  const programs::Entries entries = programs::entries_of(loaded.mechanism, loaded.plan());
  positions_ = entries.positions.size();
  state_ = positions_ + entries.velocities.size();
  for (const programs::Entry& entry : entries.positions)
    list_.push_back({entry.name, entry.unit, "position"});
  const std::size_t moving = entries.velocities.size() - loaded.mechanism.states.size();
  for (std::size_t i = 0; i < entries.velocities.size(); ++i) {
    const programs::Entry& entry = entries.velocities[i];
    list_.push_back(i < moving ? Signal{entry.name + "_velocity", entry.unit, "velocity"}
                               : Signal{entry.name, entry.unit, "state"});
  }
  for (const char* energy : {"kinetic_energy", "potential_energy", "total_energy"})
    list_.push_back({energy, "J", "energy"});
  for (const programs::Entry& entry : entries.inputs)
    list_.push_back({entry.name + "_input", entry.unit, "input"});
  for (const programs::OutputNumber& number : programs::output_numbers(loaded.mechanism, outputs))
    list_.push_back({number.name, number.unit, "output", number.output});
  tell_apart();
}

void Signals::tell_apart() {
  std::set<std::string> taken = {"time", "kinetic_energy", "potential_energy", "total_energy"};
  std::vector<Signal*> others;
  for (Signal& signal : list_)
    if (signal.kind != "energy" && !taken.insert(signal.name).second) others.push_back(&signal);
  for (Signal* signal : others) {
    const std::string suffix = "_" + signal->kind;
    const std::string plain = signal->name + (signal->name.ends_with(suffix) ? "" : suffix);
    std::string name = plain;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}_{}", plain, i);
    renamed_.push_back(fmt::format("the {} '{}' is called '{}' here: the name is taken", signal->kind,
                                   support::shown(signal->name), support::shown(name)));
    signal->name = name;
  }
}

std::vector<std::size_t> Signals::columns(const std::vector<std::string>& chosen) const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < list_.size(); ++i)
    if (list_[i].output.empty() || chosen.empty() ||
        std::find(chosen.begin(), chosen.end(), list_[i].output) != chosen.end())
      indices.push_back(i);
  return indices;
}

std::vector<std::size_t> Signals::matching(const std::string& pattern) const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < list_.size(); ++i)
    if (matches(pattern, list_[i].name)) indices.push_back(i);
  if (!indices.empty() || pattern.empty()) return indices;
  for (std::size_t i = 0; i < list_.size(); ++i)
    if (list_[i].name.starts_with(pattern + '.') || list_[i].name.starts_with(pattern + '['))
      indices.push_back(i);
  return indices;
}

std::vector<std::size_t> Signals::positions() const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < positions_; ++i) indices.push_back(i);
  return indices;
}

std::vector<std::string> Signals::state_units() const {
  std::vector<std::string> units;
  for (std::size_t i = 0; i < state_; ++i) {
    const Signal& signal = list_[i];
    units.push_back(signal.kind == "state" ? "" : signal.unit);
  }
  return units;
}

std::vector<double> Signals::values(const studies::Flow<double>& flow, const studies::Point<double>& point,
                                    bool outputs) const {
  const jourdain_model_table& table = flow.table();
  std::vector<double> values = point.x;
  const double* z = point.x.data() + table.position_count;
  double kinetic = 0, potential = 0;
  table.kinetic_energy(&point.t, point.x.data(), z, &kinetic);
  table.potential_energy(&point.t, point.x.data(), z, &potential);
  values.insert(values.end(), {kinetic, potential, kinetic + potential});
  const std::vector<double> u = flow.inputs().at(point.t);
  values.insert(values.end(), u.begin(), u.end());
  if (!outputs) return values;
  const std::size_t before = values.size();
  values.resize(before + static_cast<std::size_t>(table.output_count));
  table.outputs(&point.t, point.x.data(), z, u.data(), values.data() + before);
  return values;
}

}  // namespace jourdain::commands
