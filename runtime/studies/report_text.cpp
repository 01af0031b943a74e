#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "studies/report.hpp"

namespace jourdain::studies {

namespace {

std::string number(const std::optional<double>& value, const char* format = "{:.2f}") {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

std::string error(double value) { return value == 0 ? "0" : fmt::format("{:.1e}", value); }

std::string methods_table(const jourdain_model_table& table, const Study& study) {
  std::string text = fmt::format("  {:<23} {:>5} {:>8} {:>11} {:>10} {:>10} {:>21}\n", "method", "order",
                                 "measured", "evaluations", "operations", "us a step", "quartiles");
  for (std::size_t m = 0; m < study.work.step_times.size(); ++m) {
    const jourdain_method& method = table.methods[m];
    const StepTime& time = study.work.step_times[m];
    text += fmt::format("  {:<23} {:>5} {:>8} {:>11} {:>10} {:>10.3g} {:>10.3g} {:>10.3g}\n", method.name,
                        method.order, number(study.work.orders[m]), method.evaluations, method.operations,
                        time.least * 1e6, time.lower_quartile * 1e6, time.upper_quartile * 1e6);
  }
  return text;
}

/// Some columns of the table of errors.
std::string errors_block(const jourdain_model_table& table, const Study& study, std::size_t first,
                         std::size_t last) {
  std::string text = fmt::format("  {:<23}", "h");
  for (std::size_t i = first; i < last; ++i) text += fmt::format(" {:>8}", time_text(study.steps[i]));
  for (std::size_t m = 0; m < study.work.step_times.size(); ++m) {
    text += fmt::format("\n  {:<23}", table.methods[m].name);
    for (const WorkPoint& point : study.work.points)
      if (point.method == m && point.h <= study.steps[first] && point.h >= study.steps[last - 1])
        text += fmt::format(" {:>7}{}", point.finite ? error(point.largest.position) : "fails",
                            point.pareto ? '*' : ' ');
  }
  return text + "\n";
}

std::string errors_table(const jourdain_model_table& table, const Study& study) {
  constexpr std::size_t kColumns = 9;
  std::string text = fmt::format(
      "\n  largest position error along the way (rad, m), compared after each step, where steps are shorter "
      "every {};\n  * on the Pareto front\n",
      time_text(study.reference.interval));
  for (std::size_t first = 0; first < study.steps.size(); first += kColumns)
    text += errors_block(table, study, first, std::min(first + kColumns, study.steps.size()));
  return text;
}

/// One of the method's, halfway between its longest and its shortest step.
const ErrorSources* middle_of(std::size_t method, const std::vector<ErrorSources>& sources) {
  std::vector<const ErrorSources*> own;
  for (const ErrorSources& source : sources)
    if (source.method == method) own.push_back(&source);
  return own.empty() ? nullptr : own[own.size() / 2];
}

std::string sources_table(const jourdain_model_table& table, const Study& study) {
  if (study.sources.empty()) return "";
  std::string text = fmt::format(
      "\n  where the position error at the end comes from (rad, m), at one step of each method\n  {:<23} "
      "{:>9} {:>10} "
      "{:>10} {:>10} {:>10} {:>10} {:>6}\n",
      "method", "h", "truncation", "propagated", "rounding", "predicted", "measured", "ratio");
  for (const SourceSummary& summary : study.summaries) {
    const ErrorSources* s = middle_of(summary.method, study.sources);
    const bool has_ratio = s && s->measured.position > 0;
    if (s)
      text += fmt::format(
          "  {:<23} {:>9} {:>10.2e} {:>10.2e} {:>10.2e} {:>10.2e} {:>10.2e} {:>6}\n",
          table.methods[s->method].name, time_text(s->h), s->truncation.position, s->propagated.position,
          s->rounding.position, s->predicted.position, s->measured.position,
          has_ratio ? fmt::format("{:.2f}", s->predicted.position / s->measured.position) : "-");
  }
  text += fmt::format("\n  {:<23} {:>17} {:>17} {:>15} {:>27}\n", "slopes over h", "truncation", "propagated",
                      "rounding", "rounding dominates below h");
  for (const SourceSummary& s : study.summaries)
    text += fmt::format("  {:<23} {:>17} {:>17} {:>15} {:>27}\n", table.methods[s.method].name,
                        number(s.truncation_slope), number(s.propagation_slope), number(s.rounding_slope),
                        s.rounding_step ? time_text(*s.rounding_step) +
                                              (s.rounding_step_extrapolated ? " (extrapolated)" : "")
                                        : "-");
  return text;
}

std::string forms_table(const Study& study) {
  if (study.forms.empty()) return "";
  std::string text = fmt::format(
      "\n  the same scene in other coordinates, each by the classical Runge-Kutta method: by plain numeric "
      "references,\n"
      "  whose times say nothing of emitted code, and \"emitted\" where the scene can be written as free "
      "bodies\n"
      "  whose joints are closed by multipliers, with one projection a step; compared every {}\n"
      "  {:<28} {:>7} {:>8} {:>9} {:>9} {:>9} {:>9}\n",
      time_text(study.options.longest_step), "form", "states", "unknowns", "h", "error, m", "drift",
      "us a step");
  for (const FormCurve& curve : study.forms) {
    std::vector<FormPoint> points;
    for (const FormPoint& point : curve.points)
      if (point.finite) points.push_back(point);
    if (points.empty())
      text += curve.points.empty()
                  ? fmt::format("  {:<28} not tried: it takes too long\n", curve.form)
                  : fmt::format("  {:<28} fails with steps of {} to {}\n", curve.form,
                                time_text(curve.points.front().h), time_text(curve.points.back().h));
    for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(1, points.size() / 2)) {
      const FormPoint& point = points[i];
      text += fmt::format("  {:<28} {:>7} {:>8} {:>9} {:>9} {:>9} {:>9.4g}\n", curve.form, curve.states,
                          curve.unknowns, time_text(point.h), error(point.position_error), error(point.drift),
                          point.step_time * 1e6);
    }
  }
  return text;
}

}  // namespace

std::string time_text(double seconds) {
  if (seconds >= 1) return fmt::format("{:.4g} s", seconds);
  if (seconds >= 0.9995e-3) return fmt::format("{:.4g} ms", seconds * 1e3);
  if (seconds >= 0.9995e-6) return fmt::format("{:.4g} us", seconds * 1e6);
  return fmt::format("{:.4g} ns", seconds * 1e9);
}

namespace {

/// What a run that holds the inputs over each step would be off by, where that is another.
std::string inputs_text(const Study& study) {
  const Advice& a = *study.advice;
  if (study.options.hold_inputs) return "; inputs held over each step";
  if (!a.error_held) return "; with inputs held over each step it FAILS";
  if (a.error_held->position <= 1.001 * a.error.position) return "";
  return fmt::format(
      "; that is with inputs sampled at the stages: held over each step, position error {:.2g} "
      "(--hold-inputs)",
      a.error_held->position);
}

/// Why nothing is recommended of a study whose reference knows enough.
std::string nothing_text(const Study& study, const std::string& asked, const std::string& remark) {
  Question question = study.options.question;
  if (question.tolerance) *question.tolerance -= study.reference.position_error;
  std::vector<WorkPoint> within;
  std::copy_if(study.work.points.begin(), study.work.points.end(), std::back_inserter(within),
               [&](const WorkPoint& point) { return keeps_within(question, point); });
  if (within.empty()) return fmt::format("no method and step of this study keep within {}{}", asked, remark);
  const auto dividing = std::count_if(within.begin(), within.end(), [&](const WorkPoint& point) {
    return divides_period(question, point.h);
  });
  if (question.budget && dividing == 0)
    return fmt::format("within {}: no recommendation, no step of this study that costs no more divides {}{}",
                       asked, time_text(question.period), remark);
  std::string or_else;
  if (question.tolerance)
    or_else = ", or a shorter step of the same method does not";
  else if (std::size_t(dividing) < within.size())
    or_else = fmt::format(", or has a step that does not divide {}", time_text(question.period));
  return fmt::format("within {}: no recommendation, what keeps within it is unstable{}{}", asked, or_else,
                     remark);
}

std::string digits_text(InFiftyDigits digits) {
  switch (digits) {
    case InFiftyDigits::kNotTried:
      return "no solution in 50 digits (--reference cvode)";
    case InFiftyDigits::kTooCostly:
      return "no solution in 50 digits (too costly here)";
    case InFiftyDigits::kContradicted:
      return "no solution in 50 digits (CVODE does not agree with it)";
    case InFiftyDigits::kSolved:
      break;
  }
  return "";
}

}  // namespace

std::string advice_text(const jourdain_model_table& table, const Study& study) {
  const Question& question = study.options.question;
  if (!question.tolerance && !question.budget) return "";
  const std::string asked =
      question.tolerance ? fmt::format("a position error of {:.3g} (rad, m)", *question.tolerance)
                         : fmt::format("{} per {}", time_text(*question.budget), time_text(question.period));
  const std::string stiff = stiff_text(table, study), remark = stiff.empty() ? "" : "; " + stiff;
  if (study.untrusted)
    return fmt::format("within {}: no recommendation, {} at t = {}", asked, study.untrusted->why,
                       time_text(study.untrusted->from));
  if (!study.advice && question.tolerance && study.reference.position_error >= *question.tolerance) {
    const InFiftyDigits digits = study.reference.digits;
    const bool helps = digits == InFiftyDigits::kNotTried || digits == InFiftyDigits::kTooCostly;
    return fmt::format(
        "within {}: no recommendation, the reference itself is only known to {:.1g}; allow more{}", asked,
        study.reference.position_error, helps ? ", or try --reference extrapolation (slow)" : "");
  }
  if (!study.advice) return nothing_text(study, asked, remark);
  const Advice& a = *study.advice;
  const std::string inputs = inputs_text(study);
  const std::string over =
      is_judged_shorter(study) ? fmt::format(" over {} only", time_text(study.judged)) : "";
  return fmt::format(
      "within {}{}: {}_step with h = {}; a run confirms it{}: position error {:.2g}, velocity error {:.2g}, "
      "compared {}, {} a step, "
      "{:.3g} times faster than real time{}{}",
      asked, over, table.methods[a.method].name, time_text(a.h), a.confirmed ? "" : " NOT", a.error.position,
      a.error.velocity,
      a.compared < 1.001 * a.h ? "after each step" : fmt::format("every {}", time_text(a.compared)),
      time_text(a.step_time), 1 / a.run_time, inputs, remark);
}

bool is_judged_shorter(const Study& study) { return study.judged < 0.999 * study.options.duration; }

std::vector<std::string> remarks(const jourdain_model_table& table, const Study& study) {
  std::vector<std::string> list;
  const double duration = study.options.duration;
  if (is_judged_shorter(study))
    list.push_back(fmt::format(
        "NOT THE WHOLE TIME: beyond {} of {} two reference solutions part by more than {:.0e}: errors are "
        "judged, and a step is recommended, up to there only",
        time_text(study.judged), time_text(duration), kParted));
  if (study.untrusted)
    list.push_back(
        fmt::format("NOT TO BE TRUSTED from t = {} on: there {} (see closed loops); no step is recommended",
                    time_text(study.untrusted->from), study.untrusted->why));
  if (study.longer > 1e-3 * duration)
    list.push_back(fmt::format("the time is {} instead of {}: whole longest steps, four at least",
                               time_text(duration), time_text(duration - study.longer)));
  list.push_back(
      fmt::format("reference: {}; its own error is {:.1e} of any entry of the state, over 1 + |entry|, and "
                  "{:.1e} rad or m of "
                  "positions (difference to a looser tolerance)",
                  study.reference.method, study.reference.error, study.reference.position_error));
  if (!study.loops.empty())
    list.push_back(fmt::format(
        "the reference moves all positions by their rates and closes the loops after each {}; there they are "
        "open by {:.0e} m",
        time_text(study.reference.interval), study.reference.open.position));
  const double growth = study.divergence.growth.back();
  const double followed = study.divergence.interval * static_cast<double>(study.divergence.growth.size() - 1);
  list.push_back(
      fmt::format("nearby trajectories separate by a factor of {:.2g} within {}, {:.2g}/s in the exponent",
                  growth, time_text(followed), study.divergence.exponent));
  if (study.has_kinks)
    list.push_back(
        "forces or inputs have kinks (if, abs, sign, min, max, floor): a step across one is off in velocity "
        "by a share of h where "
        "the force jumps, of h^2 where its slope does, whatever the order of the method");
  double failing = INFINITY;  // shortest of the steps at which nothing works
  for (const double h : study.steps) {
    const bool works = std::any_of(study.work.points.begin(), study.work.points.end(),
                                   [h](const WorkPoint& p) { return p.h == h && p.finite; });
    if (works) break;
    failing = h;
  }
  if (std::isfinite(failing))
    list.push_back(fmt::format("every method fails with steps of {} and longer", time_text(failing)));
  if (study.options.hold_inputs)
    list.push_back(
        "steps hold the inputs of their begin; the reference has them as functions of time, and the sources "
        "of the "
        "error are not told apart");
  else if (study.reference.exact.empty())
    list.push_back(digits_text(study.reference.digits) + ": the sources of the error are not told apart");
  if (study.reference.error > 1e-13 && study.reference.position_error > 0)
    list.push_back(
        fmt::format("position errors below {:.0e} (rad, m) say nothing: the reference is no better",
                    10 * study.reference.position_error));
  for (const SourceSummary& s : study.summaries) {
    const std::string name = table.methods[s.method].name;
    double longest = 0;
    for (const ErrorSources& source : study.sources)
      if (source.method == s.method) longest = std::max(longest, source.h);
    if (longest == 0) continue;
    if (!s.linear_until)
      list.push_back(fmt::format("{}: errors are outside the linear regime at every step tried", name));
    else if (*s.linear_until < 0.99 * longest)
      list.push_back(
          fmt::format("{}: the linear regime ends beyond h = {}", name, time_text(*s.linear_until)));
  }
  return list;
}

std::string report_text(const ReportHead& head, const jourdain_model_table& table, const Study& study) {
  std::string text =
      fmt::format("{}: error against run time over {} in {}{}\n", head.name, time_text(study.judged),
                  head.real, head.scenario.empty() ? "" : ", " + head.scenario);
  for (const std::string& remark : remarks(table, study)) text += wrapped(remark);
  text += "\n" + methods_table(table, study) + errors_table(table, study) + sources_table(table, study) +
          loops_text(head, table, study) + touches_text(table, study) + stability_text(table, study) +
          extremes_text(study.extremes) + forms_table(study) + alternatives_text(table, study);
  const std::string advice = advice_text(table, study);
  if (!advice.empty()) text += "\n  " + advice + "\n";
  return text;
}

}  // namespace jourdain::studies
