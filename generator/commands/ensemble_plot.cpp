#include "commands/ensemble_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/plot.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

constexpr int kPerRow = 3, kPanelWidth = 420, kPanelHeight = 280;
constexpr int kEndColour = 0, kDrawnColour = 1, kLineColour = 7;

constexpr double kRounding = 1e-12;  ///< of values of one size

struct Bins {
  double begin = 0, width = 1;
  std::vector<double> counts;

  double edge(std::size_t i) const { return begin + static_cast<double>(i) * width; }
};

/// As many as the quartiles ask for (Freedman and Diaconis, Z. Wahrscheinlichkeitstheorie 57, 1981), within bounds; one
/// where all values are the same but for rounding.
Bins bins_of(std::vector<double> values, const Statistics& s) {
  constexpr double kFewest = 8, kMost = 80, kTiny = 1e-290;
  const double range = s.greatest - s.least, size = std::max(std::fabs(s.least), std::fabs(s.greatest));
  const auto count = static_cast<double>(values.size());
  if (!(range > std::max(kRounding * size, kTiny)) || !std::isfinite(range)) {
    const double half = size > 0 ? 0.05 * size : 0.5;
    return {s.median - half, 2 * half, {count}};
  }
  std::sort(values.begin(), values.end());
  const double quartiles = values[values.size() * 3 / 4] - values[values.size() / 4];
  const double wanted = quartiles > 0 ? range / (2 * quartiles / std::cbrt(count)) : kMost;
  const auto bins = static_cast<std::size_t>(std::clamp(std::ceil(wanted), kFewest, kMost));
  Bins result{s.least, range / static_cast<double>(bins), std::vector<double>(bins, 0)};
  for (const double value : values)
    ++result.counts[std::min(static_cast<std::size_t>((value - s.least) / result.width), bins - 1)];
  return result;
}

/// What values are counted from: zero, or the median where they differ in digits that an axis has no room for.
double origin_of(const Statistics& s) {
  constexpr double kNarrow = 1e-3;
  const double range = s.greatest - s.least, size = std::max(std::fabs(s.least), std::fabs(s.greatest));
  return range > kRounding * size && range < kNarrow * size ? s.median : 0;
}

report::Series outline(const Bins& bins, int colour) {
  report::Series series{"", {bins.edge(0)}, {0}, colour, true, false, false, true};
  for (std::size_t i = 0; i < bins.counts.size(); ++i) {
    series.x.insert(series.x.end(), {bins.edge(i), bins.edge(i + 1)});
    series.y.insert(series.y.end(), {bins.counts[i], bins.counts[i]});
  }
  series.x.push_back(bins.edge(bins.counts.size()));
  series.y.push_back(0);
  return series;
}

/// 1, 2 or 5 times a power of ten, so that a range has at most six marks.
double mark_step(double range) {
  constexpr double kSteps = 5;
  const double power = std::pow(10, std::floor(std::log10(range / kSteps)));
  const double steps = range / kSteps / power;
  return power * (steps <= 1 ? 1 : steps <= 2 ? 2 : steps <= 5 ? 5 : 10);
}

report::Plot panel(const EnsembleColumn& column, std::vector<double> values, Statistics s,
                   std::size_t number) {
  const double origin = origin_of(s);
  for (double& value : values) value -= origin;
  for (double* value : {&s.least, &s.low, &s.median, &s.high, &s.greatest}) *value -= origin;
  const Bins bins = bins_of(values, s);
  report::Plot plot;
  plot.name = fmt::format("column{}", number);
  plot.title = column.is_drawn ? "drawn" : "at the end";
  plot.x_title = column.name + (origin != 0 ? fmt::format(" less {:.9g}", origin) : "") +
                 (column.unit.empty() ? "" : ", " + column.unit);
  plot.y_title = "states";
  plot.x_logarithmic = plot.y_logarithmic = false;
  plot.height = kPanelHeight;
  plot.width = kPanelWidth;
  plot.x_step = mark_step(bins.edge(bins.counts.size()) - bins.begin);
  plot.series.push_back(outline(bins, column.is_drawn ? kDrawnColour : kEndColour));
  const double top = *std::max_element(bins.counts.begin(), bins.counts.end());
  for (const double at : {s.low, s.median, s.high})
    plot.series.push_back({"", {at, at}, {0, top}, kLineColour, true, false, at != s.median, false});
  return plot;
}

}  // namespace

bool is_plot_possible(const std::string& file) {
  if (file.empty()) return true;
  if (!file.ends_with(".svg")) {
    fmt::print(stderr, "error: --plot {}: a file that ends in .svg is expected\n", support::shown(file));
    return false;
  }
  report::check_plotter();
  return true;
}

std::string ensemble_plot(const EnsembleResult& result, const std::vector<Statistics>& statistics) {
  std::vector<report::Plot> plots;
  for (std::size_t i = 0; i < result.columns.size(); ++i)
    plots.push_back(panel(result.columns[i], result.of_trusted(result.values(i)), statistics[i], i));
  const EnsembleFacts& facts = result.facts;
  return report::tiled(
      report::draw(plots),
      fmt::format("{}: {} states; lines at 5 %, the median and 95 %", facts.model, result.shard.size()),
      kPerRow, kPanelWidth, kPanelHeight);
}

std::string with_plot(const std::string& files, const std::string& file, const EnsembleResult& result,
                      const std::vector<Statistics>& statistics) {
  if (file.empty()) return files;
  if (statistics.empty()) {
    fmt::print(stderr, "note: no plot: no state is to be trusted\n");
    return files;
  }
  support::write_file(file, ensemble_plot(result, statistics));
  return files.empty() ? file : files + ", " + file;
}

}  // namespace jourdain::commands
