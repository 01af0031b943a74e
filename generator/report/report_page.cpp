#include "report/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "emit/templates.hpp"
#include "report/answer.hpp"
#include "report/guide.hpp"
#include "report/page_scene.hpp"
#include "report/plot.hpp"
#include "report/stability_page.hpp"

namespace jourdain::report {

namespace {

using studies::ErrorSources;
using studies::Study;
using studies::WorkPoint;

Plot work_precision_plot(const jourdain_model_table& table, const Study& study) {
  Plot plot{"work_precision",
            "Error against run time; dashed: the order's slope, where errors follow it",
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
    const Series line = order_guide(series, table.methods[m].order, floor);
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

std::string sources_name(const std::string& method) { return "error_sources_" + method; }

Plot sources_plot(const jourdain_model_table& table, const Study& study, std::size_t method) {
  Plot plot{sources_name(table.methods[method].name),
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

std::string items(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "<li>" + escaped(sentence) + "</li>\n";
  return text;
}

std::string list(const std::vector<std::string>& sentences) {
  return "<ul>\n" + items(sentences) + "</ul>\n";
}

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

std::string touches_section(const jourdain_model_table& table, const Study& study) {
  std::string text = list(studies::touches_remarks(table, study)) + "<div class=\"table\"><table>";
  std::vector<std::vector<std::string>> rows = studies::touches_rows(study);
  rows.insert(rows.begin(), studies::touches_head(study));
  for (const std::vector<std::string>& row : rows) {
    const char* cell = &row == &rows.front() ? "th" : "td";
    text += "<tr>";
    for (const std::string& entry : row) text += fmt::format("<{0}>{1}</{0}>", cell, escaped(entry));
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string alternatives_table(const jourdain_model_table& table, const Study& study) {
  const auto row = [](const std::vector<std::string>& cells, const char* tag) {
    std::string text = "<tr>";
    for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
    return text + "</tr>\n";
  };
  std::string text = "<div class=\"table\"><table>" + row(studies::alternatives_head(), "th");
  for (const std::vector<std::string>& cells : studies::alternatives_rows(study)) text += row(cells, "td");
  return text + "</table></div>\n" + list(studies::alternatives_remarks(table, study));
}

/// A part of the page: text, then its plots.
struct Section {
  std::string title, text;
  std::vector<Plot> plots;
};

std::string explained(const std::string& text) { return "<p class=\"soft\">" + text + "</p>\n"; }

Section work_section(const jourdain_model_table& table, const Study& study) {
  return {"Error against run time",
          explained(fmt::format(
              "Each row is a method, each column from the sixth on a length of the step; the entries are "
              "its largest position errors (rad, m) after a step; where steps are shorter than {} these are "
              "compared that often. Halving the step divides the error by about 2 to the "
              "power of the order. Blue: no other entry is both faster and more accurate.",
              studies::time_text(study.reference.interval))) +
              errors_table(table, study),
          {work_precision_plot(table, study)}};
}

Section sources_section(const jourdain_model_table& table, const Study& study) {
  return {"Where the error comes from",
          explained("Truncation: what each step by itself is off by. Propagated: what becomes of that by the "
                    "end. Rounding: every number is kept to so many digits only. The table has the powers of "
                    "h that they grow with.") +
              sources_table(table, study),
          {sources_plot(table, study, shown_method(table, study, 4))}};
}

Section stability_section(const jourdain_model_table& table, const Study& study) {
  const std::vector<std::string> remarks = studies::stability_remarks(table, study);
  std::vector<std::string> plain;
  std::remove_copy_if(remarks.begin(), remarks.end(), std::back_inserter(plain), is_warning);
  return {"Stability",
          explained(
              "With longer steps than these the errors of a method are expected to grow from step to step.") +
              warnings_html(remarks) + stability_table(table, study) + list(plain),
          stability_plots(table, study)};
}

Section energy_section(const jourdain_model_table& table, const Study& study) {
  return {"Energy",
          explained("Nothing drives or brakes this mechanism: its energy should not change."),
          {energy_plot(table, study)}};
}

std::vector<Section> sections_of(const studies::ReportHead& head, const jourdain_model_table& table,
                                 const Study& study) {
  std::vector<Section> list = {work_section(table, study)};
  if (!study.alternatives.rows.empty())
    list.push_back({"Other integrators at equal error", alternatives_table(table, study), {}});
  if (!study.sources.empty()) list.push_back(sources_section(table, study));
  if (!study.stability.points.empty()) list.push_back(stability_section(table, study));
  if (!head.loops.empty()) list.push_back({"Closed loops", loops_section(head, table, study), {}});
  if (study.touches) list.push_back({"One-sided elements", touches_section(table, study), {}});
  if (!study.extremes.empty()) list.push_back({"Extremes", extremes_table(study), {}});
  if (study.options.conserves_energy) list.push_back(energy_section(table, study));
  if (!study.forms.empty()) list.push_back({"Equations of the first kind", "", {forms_plot(study)}});
  return list;
}

/// The plots that show something become files and stand in their section; instead of others it says so.
std::string section_html(const Section& section, std::vector<support::FileText>& files) {
  std::string text = fmt::format("<h2>{}</h2>\n{}", escaped(section.title), section.text);
  std::vector<Plot> shown;
  std::copy_if(section.plots.begin(), section.plots.end(), std::back_inserter(shown), shows_anything);
  const std::vector<std::string> svgs = draw(shown);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    text += "<figure>" + svgs[i] + "</figure>\n";
    files.push_back({shown[i].name + ".svg", svgs[i]});
  }
  for (const Plot& plot : section.plots)
    if (!shows_anything(plot))
      text +=
          explained("Not drawn, for it has no values that its axes can show: " + escaped(plot.title) + ".");
  return text;
}

std::string basis_html(const std::vector<std::string>& remarks, const std::string& provenance) {
  std::vector<std::string> plain;
  std::remove_copy_if(remarks.begin(), remarks.end(), std::back_inserter(plain), is_warning);
  return "<h2>What the numbers rest on</h2>\n" + list(plain) + explained(escaped(provenance));
}

std::string provenance_text(const studies::ReportHead& head, const Study& study) {
  const std::string scenario = head.scenario.empty() ? "" : "; " + head.scenario;
  return fmt::format("{} in {} over {}{}. From {} (SHA-256 {}), compiled by {}.", head.generator, head.real,
                     studies::time_text(study.judged), scenario, head.path, head.sha256.substr(0, 12),
                     head.compiler);
}

}  // namespace

std::vector<support::FileText> report_pages(const studies::ReportHead& head,
                                            const studies::Flow<double>& flow, const Study& study,
                                            const Figure& figure) {
  const jourdain_model_table& table = flow.table();
  std::vector<support::FileText> files(1);
  const std::vector<std::string> remarks = studies::remarks(table, study);
  std::string sections;
  for (const Section& section : sections_of(head, table, study)) sections += section_html(section, files);
  const std::string title = head.name + (head.description.empty() ? "" : ": " + head.description);
  const std::string advice = studies::advice_text(table, study);
  const auto script = [](const char* name) { return std::string(emit::template_text(name)); };
  files[0] = {
      "report.html",
      emit::fill(
          emit::template_text("report.html.in"),
          {{"AT", "@"},
           {"TITLE", escaped(head.name) + ": error against run time"},
           {"HEADING", escaped(title)},
           {"WARNINGS", warnings_html(remarks)},
           {"ANSWER", answer_html(table, study)},
           {"ADVICE", advice.empty() ? "" : explained("In the report's words: " + escaped(advice) + ".")},
           {"BASIS", basis_html(remarks, provenance_text(head, study))},
           {"SECTIONS", sections},
           {"FIGURE", scene_json(flow, study, figure)},
           {"SCENE", script("report_scene.js.in")},
           {"PLAYER", script("report_player.js.in")}})};
  return files;
}

std::vector<std::string> page_names(const std::vector<std::string>& methods) {
  std::vector<std::string> names = {"report.html",          "work_precision.svg", "stability_regions.svg",
                                    "stability_limits.svg", "energy_drift.svg",   "first_kind.svg"};
  for (const std::string& method : methods) names.push_back(sources_name(method) + ".svg");
  return names;
}

}  // namespace jourdain::report
