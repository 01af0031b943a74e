#include "report/stability_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "studies/report.hpp"

namespace jourdain::report {

namespace {

using studies::MethodLimit;
using studies::StabilityFunction;
using studies::StabilityPoint;
using studies::Study;

constexpr double kShown = 6;  ///< largest |hµ| drawn: regions of explicit methods end well before

const StabilityFunction* function_of(const jourdain_model_table& table, std::size_t method) {
  return studies::stability_function(table.methods[method].name);
}

/// A step and whose it is.
struct ShownStep {
  std::size_t method = 0;
  double h = 0;
  bool recommended = false;
};

/// The recommended step where its method has a region to show, else the limit of the method that allows most.
std::optional<ShownStep> shown_step(const jourdain_model_table& table, const Study& study) {
  const auto has_region = [&table](std::size_t method) {
    const StabilityFunction* function = function_of(table, method);
    return function && !studies::region_boundary(*function).empty();
  };
  if (study.advice && has_region(study.advice->method))
    return ShownStep{study.advice->method, study.advice->h, true};
  std::optional<ShownStep> longest;
  for (const MethodLimit& limit : study.stability.limits)
    if (const double h = studies::largest_stable_step(limit);
        h > 0 && std::isfinite(h) && has_region(limit.method) && (!longest || h > longest->h))
      longest = ShownStep{limit.method, h, false};
  return longest;
}

Plot regions_plot(const jourdain_model_table& table, const Study& study, const ShownStep& step) {
  const char* name = table.methods[step.method].name;
  Plot plot{
      "stability_regions",
      fmt::format("Eigenvalues along the trajectory times h = {} ({} {}); lines: where methods turn unstable",
                  studies::time_text(step.h), step.recommended ? "recommended for" : "largest of", name),
      "Re hµ",
      "Im hµ",
      false,
      false,
      {}};
  for (std::size_t m = 0; m < study.stability.limits.size(); ++m) {
    const StabilityFunction* function = function_of(table, m);
    if (!function) continue;
    Series boundary{table.methods[m].name, {}, {}, static_cast<int>(m), true, false};
    for (const std::complex<double> x : studies::region_boundary(*function)) {
      boundary.x.push_back(x.real());
      boundary.y.push_back(x.imag());
    }
    plot.series.push_back(std::move(boundary));
  }
  Series modes{"hµ", {}, {}, 7, false, true};
  for (const StabilityPoint& point : study.stability.points)
    for (const std::complex<double> mu : point.eigenvalues) {
      if (std::abs(step.h * mu) > kShown) continue;
      modes.x.push_back(step.h * mu.real());
      modes.y.push_back(step.h * mu.imag());
    }
  plot.series.push_back(std::move(modes));
  return plot;
}

Plot limits_plot(const jourdain_model_table& table, const Study& study) {
  Plot plot{"stability_limits",
            "Largest stable step at each time, predicted",
            "t, s",
            "largest stable step, s",
            false,
            true,
            {}};
  for (std::size_t m = 0; m < study.stability.limits.size(); ++m) {
    Series series{table.methods[m].name, {}, {}, static_cast<int>(m), true, false};
    for (const StabilityPoint& point : study.stability.points) {
      series.x.push_back(point.time);
      series.y.push_back(point.limits[m]);
    }
    const bool any =
        std::any_of(series.y.begin(), series.y.end(), [](double h) { return h > 0 && std::isfinite(h); });
    if (any) plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace

std::vector<Plot> stability_plots(const jourdain_model_table& table, const Study& study) {
  if (study.stability.points.empty()) return {};
  std::vector<Plot> plots;
  if (const auto step = shown_step(table, study)) plots.push_back(regions_plot(table, study, *step));
  Plot limits = limits_plot(table, study);
  if (!limits.series.empty()) plots.push_back(std::move(limits));
  return plots;
}

std::string stability_table(const jourdain_model_table& table, const Study& study) {
  std::string text =
      "<div class=\"table\"><table><tr><th>largest stable step</th><th>predicted</th><th>observed</th>"
      "<th>at t</th><th>deciding mode, 1/s</th><th>it is</th></tr>\n";
  for (const MethodLimit& limit : study.stability.limits) {
    const bool any = limit.predicts;
    text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        table.methods[limit.method].name, studies::limit_text(limit),
                        studies::observed_text(limit), any ? fmt::format("{:.4g} s", limit.time) : "-",
                        any ? studies::mode_text(limit.mode) : "-", studies::judged_text(limit));
  }
  return text + "</table></div>\n";
}

std::string extremes_table(const Study& study) {
  std::string text =
      "<p class=\"soft\">Accelerations far from the usual, against 50 digits: worst errors in units of "
      "rounding, and at which "
      "factor.</p>\n<div "
      "class=\"table\"><table><tr><th>swept</th><th>range</th><th>backward</th><th>forward</th>"
      "<th>not finite at</th></tr>\n";
  for (const std::vector<std::string>& row : studies::extremes_rows(study.extremes))
    text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", row[0], row[1],
                        row[2], row[3], row[4]);
  return text + "</table></div>\n";
}

}  // namespace jourdain::report
