#include "commands/signal_plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/plot.hpp"

namespace jourdain::commands {

namespace {

constexpr std::size_t kPlottedPoints = 2000;
constexpr int kPanelHeight = 400, kColours = 8;

std::string axis_title(const std::string& unit) {
  if (unit == "1") return "without unit";
  return unit.empty() ? "unit not stated" : unit;
}

report::Series series_of(const SampledSignal& sampled, const std::vector<double>& times, int index) {
  report::Series series{sampled.signal.name, {}, {}, index, true, false, index >= kColours};
  const std::size_t stride = times.size() / kPlottedPoints + 1;
  for (std::size_t k = 0; k < times.size(); k += stride) {
    series.x.push_back(times[k]);
    series.y.push_back(sampled.values[k]);
  }
  return series;
}

/// A plot for each unit, in the order of the signals; those that show nothing are left out.
std::vector<report::Plot> plots_of(const std::string& title, const std::vector<double>& times,
                                   const std::vector<SampledSignal>& signals) {
  std::vector<std::string> units;
  std::vector<report::Plot> plots;
  for (const SampledSignal& sampled : signals) {
    const auto at = std::find(units.begin(), units.end(), sampled.signal.unit);
    const auto index = static_cast<std::size_t>(at - units.begin());
    if (at == units.end()) {
      units.push_back(sampled.signal.unit);
      plots.push_back(
          {fmt::format("signals{}", index), "", "t, s", axis_title(sampled.signal.unit), false, false, {}});
    }
    const int count = static_cast<int>(plots[index].series.size());
    plots[index].series.push_back(series_of(sampled, times, count));
  }
  std::erase_if(plots, [](const report::Plot& plot) { return !report::shows_anything(plot); });
  if (!plots.empty()) plots.front().title = title;
  return plots;
}

}  // namespace

std::string signal_plot(const std::string& title, const std::vector<double>& times,
                        const std::vector<SampledSignal>& signals) {
  std::vector<report::Plot> plots = plots_of(title, times, signals);
  if (plots.empty()) return "";
  if (plots.size() == 1) return report::draw(plots).front();
  for (report::Plot& plot : plots) plot.height = kPanelHeight;
  return report::stacked(report::draw(plots), kPanelHeight);
}

}  // namespace jourdain::commands
