#include "commands/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "commands/plot.hpp"
#include "commands/stability_page.hpp"
#include "emit/templates.hpp"

namespace jourdain::commands {

namespace {

using studies::ErrorSources;
using studies::Study;
using studies::WorkPoint;

constexpr double kFrameInterval = 0.02;  ///< s, of the animation
constexpr std::size_t kMostFrames = 1500;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// A guide of slope `order` through the last point of a series.
Series guide(const Series& series, int order, double x_power) {
  Series line{"", {}, {}, series.colour, true, false, true};
  if (series.x.empty()) return line;
  const double x = series.x.back(), y = series.y.back();
  const double first = series.x.front();
  for (const double at : {first, x}) {
    line.x.push_back(at);
    line.y.push_back(y * std::pow(at / x, x_power * order));
  }
  return line;
}

/// Points of one method that lie well above the floor of rounding, for the guide.
Series truncated(const Series& series, double floor) {
  Series result = series;
  while (!result.y.empty() && result.y.back() < 30 * floor) {
    result.x.pop_back();
    result.y.pop_back();
  }
  return result;
}

Plot work_precision_plot(const jourdain_model_table& table, const Study& study) {
  Plot plot{"work_precision",
            "Error against run time; dashed: slopes of the methods' orders",
            "run time per simulated second, s",
            "largest position error, rad or m",
            true,
            true,
            {}};
  double floor = 1;
  for (const WorkPoint& p : study.work.points)
    if (p.finite && p.largest.position > 0) floor = std::min(floor, p.largest.position);
  for (std::size_t m = 0; m < study.work.step_times.size(); ++m) {
    Series series{table.methods[m].name, {}, {}, static_cast<int>(m)};
    for (const WorkPoint& p : study.work.points) {
      if (p.method != m || !p.finite || p.largest.position > 10) continue;
      series.x.push_back(p.run_time);
      series.y.push_back(p.largest.position);
    }
    // Run time grows with 1/h.
    const Series line = guide(truncated(series, floor), table.methods[m].order, -1);
    plot.series.push_back(std::move(series));
    plot.series.push_back(line);
  }
  if (study.advice) {
    const double step = study.advice->step_time / study.advice->h;
    plot.series.push_back({"recommended", {step}, {study.advice->error.position}, 7, false, true});
  }
  return plot;
}

/// The method whose parts are the most telling: the highest order that has some.
std::size_t shown_method(const jourdain_model_table& table, const Study& study, int order) {
  std::size_t best = study.sources.front().method;
  for (const ErrorSources& s : study.sources)
    if (std::abs(table.methods[s.method].order - order) < std::abs(table.methods[best].order - order))
      best = s.method;
  return best;
}

Plot sources_plot(const jourdain_model_table& table, const Study& study, std::size_t method) {
  Plot plot{fmt::format("error_sources_{}", table.methods[method].name),
            fmt::format("Where the error of {} at the end comes from", table.methods[method].name),
            "h, s",
            "position error, rad or m",
            true,
            true,
            {}};
  Series truncation{"truncation (sum of local)", {}, {}, 0}, propagated{"propagated", {}, {}, 1},
      rounding{"rounding", {}, {}, 2}, predicted{"propagated + rounding", {}, {}, 3, true, false, true},
      measured{"measured", {}, {}, 7, false, true};
  for (const ErrorSources& s : study.sources) {
    if (s.method != method) continue;
    const auto add = [&s](Series& series, double value) {
      series.x.push_back(s.h);
      series.y.push_back(value);
    };
    add(truncation, s.truncation.position);
    add(propagated, s.propagated.position);
    add(rounding, s.rounding.position);
    add(predicted, s.predicted.position);
    add(measured, s.measured.position);
  }
  for (const studies::RoundingPoint& p : study.roundings)
    if (p.method == method) {
      rounding.x.push_back(p.h);
      rounding.y.push_back(p.rounding.position);
    }
  for (const WorkPoint& p : study.work.points)
    if (p.method == method && p.finite && p.h < 0.99 * measured.x.back()) {
      measured.x.push_back(p.h);
      measured.y.push_back(p.end.position);
    }
  plot.series = {truncation, propagated, rounding, predicted, measured};
  return plot;
}

Plot energy_plot(const jourdain_model_table& table, const Study& study) {
  Plot plot{"energy_drift", "Energy drift", "h, s", "largest drift of the energy, J", true, true, {}};
  for (std::size_t m = 0; m < study.work.step_times.size(); ++m) {
    Series series{table.methods[m].name, {}, {}, static_cast<int>(m)};
    for (const WorkPoint& p : study.work.points) {
      if (p.method != m || !p.finite || !p.energy_drift) continue;
      series.x.push_back(p.h);
      series.y.push_back(*p.energy_drift);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Plot forms_plot(const Study& study) {
  Plot plot{"first_kind",
            "Generalized coordinates and equations of the first kind; emitted where it says so",
            "run time per simulated second, s",
            "largest position error of a body, m",
            true,
            true,
            {}};
  int colour = 0;
  for (const studies::FormCurve& curve : study.forms) {
    Series error{curve.form, {}, {}, colour},
        drift{curve.form + ": drift", {}, {}, colour, true, false, true};
    for (const studies::FormPoint& p : curve.points) {
      if (!p.finite) continue;
      for (Series* series : {&error, &drift}) series->x.push_back(p.step_time / p.h);
      error.y.push_back(p.position_error);
      drift.y.push_back(p.drift);
    }
    plot.series.push_back(error);
    plot.series.push_back(drift);
    ++colour;
  }
  return plot;
}

std::string cell(double value) { return value == 0 ? "0" : fmt::format("{:.1e}", value); }

std::string errors_table(const jourdain_model_table& table, const Study& study) {
  std::string text =
      "<div class=\"table\"><table><tr><th>method</th><th>order</th><th>measured</th><th>operations</th>"
      "<th>step</th>";
  for (const double h : study.steps) text += fmt::format("<th>{}</th>", studies::time_text(h));
  for (std::size_t m = 0; m < study.work.step_times.size(); ++m) {
    const auto& order = study.work.orders[m];
    text += fmt::format("</tr>\n<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
                        table.methods[m].name, table.methods[m].order,
                        order ? fmt::format("{:.2f}", *order) : "-", table.methods[m].operations,
                        studies::time_text(study.work.step_times[m].least));
    for (const WorkPoint& p : study.work.points)
      if (p.method == m)
        text += fmt::format("<td{}>{}</td>", p.pareto ? " class=\"pareto\"" : "",
                            p.finite ? cell(p.largest.position) : "fails");
  }
  return text + "</tr></table></div>\n";
}

std::string sources_table(const jourdain_model_table& table, const Study& study) {
  std::string text =
      "<div class=\"table\"><table><tr><th>slopes over "
      "h</th><th>truncation</th><th>propagated</th><th>rounding</th>"
      "<th>rounding dominates below</th><th>linear up to</th></tr>\n";
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.2f}", *value) : std::string("-");
  };
  for (const studies::SourceSummary& s : study.summaries)
    text +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}{}</td><td>{}</td></tr>\n",
                    table.methods[s.method].name, number(s.truncation_slope), number(s.propagation_slope),
                    number(s.rounding_slope), s.rounding_step ? studies::time_text(*s.rounding_step) : "-",
                    s.rounding_step && s.rounding_step_extrapolated ? " (extrapolated)" : "",
                    s.linear_until ? studies::time_text(*s.linear_until) : "-");
  return text + "</table></div>\n";
}

using Axis = std::array<double, 3>;

/// Right-handed axes: the third is against gravity, the first the inertial axis that is nearest to level.
std::array<Axis, 3> view_axes(const model::Mechanism& mechanism) {
  Axis up{0, 0, 1};
  Axis g{};
  std::vector<double> parameters;
  for (const model::Parameter& p : mechanism.parameters) parameters.push_back(p.value);
  for (std::size_t i = 0; i < 3; ++i) g[i] = mechanism.gravity[i].evaluate<double>(parameters);
  const double strength = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  if (strength > 0)
    for (std::size_t i = 0; i < 3; ++i) up[i] = -g[i] / strength;
  Axis across{1, 0, 0};
  if (std::fabs(up[0]) > 0.9) across = {0, 1, 0};
  const double share = across[0] * up[0] + across[1] * up[1] + across[2] * up[2];
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) across[i] -= share * up[i], length += across[i] * across[i];
  for (double& entry : across) entry /= std::sqrt(length);
  const Axis depth{up[1] * across[2] - up[2] * across[1], up[2] * across[0] - up[0] * across[2],
                   up[0] * across[1] - up[1] * across[0]};
  return {across, depth, up};
}

/// The points at one state, x y z each, to a tenth of a millimetre of a metre-sized mechanism.
std::string frame_text(const studies::Flow<double>& flow, const studies::Point<double>& point,
                       const Figure& figure) {
  const jourdain_model_table& table = flow.table();
  std::vector<double> u(static_cast<std::size_t>(table.input_count)),
      values(static_cast<std::size_t>(table.output_count));
  table.outputs(&point.t, point.x.data(), point.x.data() + table.position_count, u.data(), values.data());
  std::string text;
  for (std::size_t p = 0; p < figure.point_count; ++p)
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = values[12 * p + i];
      text += fmt::format("{}{:.5g}", text.empty() ? "" : ",", std::fabs(value) < 1e-9 ? 0.0 : value);
    }
  return "[" + text + "]";
}

std::string figure_json(const studies::Flow<double>& flow, const Study& study, const Figure& figure) {
  const studies::ReferenceSolution& reference = study.reference;
  const auto most = std::max<std::size_t>(1, reference.points.size() / kMostFrames);
  const auto stride =
      std::max(most, static_cast<std::size_t>(std::lround(kFrameInterval / reference.interval)));
  std::string frames, lines, masses;
  for (std::size_t k = 0; k < reference.points.size(); k += stride)
    frames += (frames.empty() ? "" : ",\n") + frame_text(flow, reference.points[k], figure);
  const auto kind = [](LineKind k) {
    return k == LineKind::kBody ? "body" : k == LineKind::kSlide ? "slide" : "spring";
  };
  for (const FigureLine& line : figure.lines)
    lines += fmt::format("{}{{\"kind\":\"{}\",\"from\":{},\"to\":{}}}", lines.empty() ? "" : ",",
                         kind(line.kind), line.from, line.to);
  for (const FigureMass& mass : figure.masses)
    masses +=
        fmt::format("{}{{\"point\":{},\"mass\":{:.6g}}}", masses.empty() ? "" : ",", mass.point, mass.mass);
  const auto axes = view_axes(figure.mechanism);
  const auto axis = [](const Axis& a) { return fmt::format("[{:.6g},{:.6g},{:.6g}]", a[0], a[1], a[2]); };
  return fmt::format(
      "{{\"interval\":{:.9g},\"duration\":{:.9g},\"view\":{{\"turn\":0.5,\"tilt\":0.3}},\"axes\":[{},{},{}],"
      "\"lines\":[{}],\"masses\":[{}],\"frames\":[\n{}]}}",
      reference.interval * static_cast<double>(stride), study.judged, axis(axes[0]), axis(axes[1]),
      axis(axes[2]), lines, masses, frames);
}

std::string section(const std::string& title, const std::string& text) {
  return fmt::format("<h2>{}</h2>\n{}", escaped(title), text);
}

std::string items(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "<li>" + escaped(sentence) + "</li>\n";
  return text;
}

std::string list(const std::vector<std::string>& sentences) {
  return "<ul>\n" + items(sentences) + "</ul>\n";
}

std::string drawing(const std::string& svg) { return "<figure>" + svg + "</figure>\n"; }

std::string loops_section(const studies::ReportHead& head, const jourdain_model_table& table,
                          const Study& study) {
  std::string text =
      list(head.loops) + fmt::format(
                             "<p class=\"soft\">How far the loops open over the run, largest of all rows; "
                             "each step ends with {}.</p>\n",
                             escaped(head.closing));
  text +=
      "<div class=\"table\"><table><tr><th>method</th><th>h</th><th>steps</th><th>|g|, m</th>"
      "<th>rate, m/s</th></tr>\n";
  for (const std::vector<std::string>& row : studies::loop_rows(table, study)) {
    text += "<tr>";
    for (const std::string& entry : row) text += "<td>" + escaped(entry) + "</td>";
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string alternatives_section(const jourdain_model_table& table, const Study& study) {
  const auto row = [](const std::vector<std::string>& cells, const char* tag) {
    std::string text = "<tr>";
    for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
    return text + "</tr>\n";
  };
  std::string text = "<div class=\"table\"><table>" + row(studies::alternatives_head(), "th");
  for (const std::vector<std::string>& cells : studies::alternatives_rows(study)) text += row(cells, "td");
  return text + "</table></div>\n" + list(studies::alternatives_remarks(table, study));
}

}  // namespace

std::vector<support::FileText> report_pages(const studies::ReportHead& head,
                                            const studies::Flow<double>& flow, const Study& study,
                                            const Figure& figure) {
  const jourdain_model_table& table = flow.table();
  std::vector<Plot> plots = {work_precision_plot(table, study)};
  const bool has_sources = !study.sources.empty(), has_energy = study.options.conserves_energy;
  const bool has_forms = !study.forms.empty();
  if (has_sources) plots.push_back(sources_plot(table, study, shown_method(table, study, 4)));
  const std::vector<Plot> of_stability = stability_plots(table, study);
  plots.insert(plots.end(), of_stability.begin(), of_stability.end());
  if (has_energy) plots.push_back(energy_plot(table, study));
  if (has_forms) plots.push_back(forms_plot(study));
  const std::vector<std::string> svgs = draw(plots);
  std::size_t next = 0;
  std::string sections =
      section("Error against run time",
              "<p class=\"soft\">Largest position error along the way (rad, m) by step size; the "
              "Pareto front stands out.</p>\n" +
                  errors_table(table, study) + drawing(svgs[next++]));
  if (!study.alternatives.rows.empty())
    sections += section("Other integrators at equal error", alternatives_section(table, study));
  if (has_sources)
    sections += section("Where the error comes from", sources_table(table, study) + drawing(svgs[next++]));
  if (!study.stability.points.empty()) {
    std::string text = stability_table(table, study) + list(studies::stability_remarks(table, study));
    for (std::size_t i = 0; i < of_stability.size(); ++i) text += drawing(svgs[next++]);
    sections += section("Stability", text);
  }
  if (!head.loops.empty()) sections += section("Closed loops", loops_section(head, table, study));
  if (!study.extremes.empty()) sections += section("Extremes", extremes_table(study));
  if (has_energy) sections += section("Energy", drawing(svgs[next++]));
  if (has_forms) sections += section("Equations of the first kind", drawing(svgs[next++]));
  const std::string remarks = items(studies::remarks(table, study));
  const std::string advice = studies::advice_text(table, study);
  const std::string scenario = head.scenario.empty() ? "" : "; " + head.scenario;
  const std::string page = emit::fill(
      emit::template_text("report.html.in"),
      {{"AT", "@"},
       {"TITLE", escaped(head.name) + ": error against run time"},
       {"HEADING", escaped(head.name + (head.description.empty() ? "" : ": " + head.description))},
       {"PROVENANCE", escaped(fmt::format("{} in {} over {}{}. From {} (SHA-256 {}), compiled by {}.",
                                          head.generator, head.real, studies::time_text(study.judged),
                                          scenario, head.path, head.sha256.substr(0, 12), head.compiler))},
       {"ADVICE", advice.empty() ? "" : "<p class=\"advice\">" + escaped(advice) + "</p>"},
       {"REMARKS", remarks},
       {"SECTIONS", sections},
       {"FIGURE", figure_json(flow, study, figure)}});
  std::vector<support::FileText> files = {{"report.html", page}};
  for (std::size_t i = 0; i < plots.size(); ++i) files.push_back({plots[i].name + ".svg", svgs[i]});
  return files;
}

}  // namespace jourdain::commands
