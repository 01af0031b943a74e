#include "commands/signal_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "support/diagnostics.hpp"

namespace jourdain::commands {

namespace {

/// "no output 'a'; did you mean 'b'?"
std::string no_such(const std::string& what, const std::string& name, const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 30;
  const std::string near = support::nearest(name, names);
  std::string hint = fmt::format("did you mean '{}'?", support::shown(near));
  if (names.empty())
    hint = "the model has none";
  else if (near.empty()) {
    const std::size_t count = std::min(names.size(), kShown);
    hint =
        fmt::format("there are {}", fmt::join(names.begin(), names.begin() + static_cast<long>(count), ", "));
    if (count < names.size()) hint += fmt::format(" and {} more", names.size() - count);
  }
  return fmt::format("no {} '{}'; {}", what, support::shown(name), hint);
}

/// Appends what `pattern` matches and is not there yet; whether it matches anything.
bool add_matching(const Signals& signals, const std::string& pattern, std::vector<std::size_t>& drawn) {
  const std::vector<std::size_t> found = signals.matching(pattern);
  for (const std::size_t i : found)
    if (std::find(drawn.begin(), drawn.end(), i) == drawn.end()) drawn.push_back(i);
  return !found.empty();
}

}  // namespace

std::string unknown_output(const model::Mechanism& mechanism, const std::vector<std::string>& chosen) {
  std::vector<std::string> names;
  for (const model::Output& output : mechanism.outputs) names.push_back(output.name);
  for (const std::string& name : chosen)
    if (std::find(names.begin(), names.end(), name) == names.end()) return no_such("output", name, names);
  return "";
}

std::optional<PlotRequest> plot_request(const std::vector<std::string>& values, const std::string& name) {
  PlotRequest request;
  for (const std::string& value : values) {
    if (!value.ends_with(".svg")) {
      request.patterns.push_back(value);
    } else if (request.file.empty()) {
      request.file = value;
    } else {
      fmt::print(stderr, "error: --plot: two files, '{}' and '{}'\n", request.file, value);
      return {};
    }
  }
  if (request.file.empty() && !values.empty()) request.file = name + ".svg";
  return request;
}

bool Selection::has_outputs(const Signals& signals) const {
  const auto is_output = [&](std::size_t i) { return !signals.list()[i].output.empty(); };
  return std::any_of(written.begin(), written.end(), is_output) ||
         std::any_of(drawn.begin(), drawn.end(), is_output);
}

std::optional<Selection> select(const Signals& signals, const std::vector<std::string>& outputs,
                                const PlotRequest& plot) {
  Selection selection{signals.columns(outputs), {}};
  if (plot.file.empty()) return selection;
  if (plot.patterns.empty()) selection.drawn = signals.positions();
  std::vector<std::string> names;
  for (const Signal& signal : signals.list()) names.push_back(signal.name);
  for (const std::string& pattern : plot.patterns)
    if (!add_matching(signals, pattern, selection.drawn)) {
      fmt::print(stderr, "error: --plot: {}\n", no_such("signal", pattern, names));
      return {};
    }
  return selection;
}

}  // namespace jourdain::commands
