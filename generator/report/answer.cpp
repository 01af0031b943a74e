#include "report/answer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace jourdain::report {

namespace {

using studies::Advice;
using studies::Study;
using studies::WorkPoint;

/// 5.1e-07 as 5.1 × 10⁻⁷, in one piece.
std::string power_text(double value) {
  if (value == 0 || (value >= 0.01 && value < 1000)) return fmt::format("{:.2g}", value);
  const double exponent = std::floor(std::log10(value));
  const std::string digits = fmt::format("{:.2g}", value / std::pow(10, exponent));
  return fmt::format("<span class=\"number\">{} × 10<sup>{}{:.0f}</sup></span>", digits,
                     exponent < 0 ? "−" : "", std::fabs(exponent));
}

/// A time in one piece.
std::string time_text(double seconds) {
  std::string text = studies::time_text(seconds);
  text.replace(text.find(' '), 1, "\u00a0");
  if (text.ends_with("us")) text.replace(text.size() - 2, 1, "µ");
  return text;
}

std::string length_text(double meters) {
  if (meters >= 1) return fmt::format("{:.3g}\u00a0m", meters);
  if (meters >= 1e-3) return fmt::format("{:.3g}\u00a0mm", meters * 1e3);
  if (meters >= 1e-6) return fmt::format("{:.3g}\u00a0µm", meters * 1e6);
  return fmt::format("{:.3g}\u00a0nm", meters * 1e9);
}

/// What an error means as a length and as an angle.
std::string error_text(double error) {
  const double degrees = error * 180 / std::numbers::pi;
  return fmt::format("<b>{}</b> (of a length: {}; of an angle: {}\u00a0degrees)",
                     power_text(error) + " m or rad", length_text(error), power_text(degrees));
}

std::string name_of(const jourdain_model_table& table, std::size_t method) {
  return fmt::format("<b>{}</b>", escaped(table.methods[method].name));
}

/// The method's point with the next longer (or shorter) step; null where none was tried.
const WorkPoint* neighbour(const Study& study, bool longer) {
  const Advice& a = *study.advice;
  const WorkPoint* next = nullptr;
  for (const WorkPoint& p : study.work.points) {
    if (p.method != a.method || (longer ? p.h < 1.001 * a.h : p.h > 0.999 * a.h)) continue;
    if (!next || (longer ? p.h < next->h : p.h > next->h)) next = &p;
  }
  return next;
}

std::string why_step(const Study& study) {
  const bool has_tolerance = study.options.question.tolerance.has_value();
  const WorkPoint* next = neighbour(study, has_tolerance);
  if (!next)
    return fmt::format("It is the {} step of this method that was tried.",
                       has_tolerance ? "longest" : "shortest");
  if (!next->finite)
    return fmt::format("With the next {} one that was tried, {}, the method fails.",
                       has_tolerance ? "longer" : "shorter", time_text(next->h));
  const std::vector<studies::MethodLimit>& limits = study.stability.limits;
  if (has_tolerance && !limits.empty() && is_beyond(limits[next->method], next->h))
    return fmt::format("The next longer one that was tried, {}, is longer than the largest stable one, {}.",
                       time_text(next->h), time_text(limits[next->method].h));
  if (has_tolerance)
    return fmt::format("With the next longer one that was tried, {}, the error is {}.", time_text(next->h),
                       power_text(next->largest.position));
  return fmt::format(
      "With the next shorter one that was tried, {}, the error is {} and each {} of motion takes {}.",
      time_text(next->h), power_text(next->largest.position), time_text(study.options.question.period),
      time_text(next->run_time * study.options.question.period));
}

std::string why_method(const jourdain_model_table& table, const Study& study) {
  const std::optional<WorkPoint>& next = study.advice->runner_up;
  if (!next) return "No other method that was tried can be recommended within it, with any of its steps.";
  const std::string who =
      fmt::format("{} with {}", escaped(table.methods[next->method].name), time_text(next->h));
  if (!study.options.question.tolerance)
    return fmt::format("The next best one within the budget, {}, has an error of {}.", who,
                       power_text(next->largest.position));
  const Advice& a = *study.advice;
  const double own = study.work.step_times[a.method].least / a.h;
  return fmt::format("The next cheapest one that keeps within it, {}, takes {:.3g} times as long.", who,
                     next->run_time / own);
}

std::string asked_text(const studies::Question& question) {
  if (question.tolerance) return fmt::format("at most {} was asked for", power_text(*question.tolerance));
  return fmt::format("the smallest was asked for that {} of run time for each {} of motion can buy",
                     time_text(*question.budget), time_text(question.period));
}

/// Where the error is too small for the reference to tell.
std::string doubt_text(const Study& study) {
  constexpr double kSharp = 1e-13;  // a reference with that error tells all that double has
  const double least = 10 * study.reference.position_error;
  if (study.reference.error <= kSharp || study.advice->error.position >= least) return "";
  return fmt::format(" The reference cannot tell errors that small: those below {} say nothing.",
                     power_text(least));
}

std::string words_html(const Study& study) {
  return fmt::format(
      "<p class=\"soft\">A <b>step</b> is how far one call of the program moves the motion on in time; a "
      "<b>method</b> is the rule by which it does so. The <b>error</b> is the largest distance of any "
      "coordinate, a length (m) or an angle (rad), from a far more accurate solution of the same equations, "
      "which itself is off by about {}.</p>\n",
      power_text(study.reference.position_error));
}

std::string recommendation_html(const jourdain_model_table& table, const Study& study) {
  const Advice& a = *study.advice;
  return fmt::format("<p class=\"lead\">Take the method {} with a step of <b>{}</b>.</p>\n",
                     name_of(table, a.method), time_text(a.h)) +
         fmt::format(
             "<p>Over {} of motion its error was never more than {}; {}. One step took {} here, so that a "
             "second of motion takes {}.{}</p>\n",
             time_text(study.judged), error_text(a.error.position), asked_text(study.options.question),
             time_text(a.step_time), time_text(a.run_time), doubt_text(study)) +
         fmt::format("<p>Why this step? {} Why this method? {}</p>\n", why_step(study),
                     why_method(table, study));
}

}  // namespace

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

bool is_warning(const std::string& remark) { return remark.starts_with("NOT "); }

std::string warnings_html(const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks)
    if (is_warning(remark)) text += "<p class=\"warning\">" + escaped(remark) + "</p>\n";
  return text;
}

std::string answer_html(const jourdain_model_table& table, const Study& study) {
  const std::string sentence = studies::advice_text(table, study);
  const bool has_answer = study.advice && !study.untrusted;
  const std::string reason =
      sentence.empty()
          ? "nothing was asked for, neither a largest error (--tolerance) nor a run time (--budget)"
          : sentence;
  const std::string text =
      has_answer
          ? recommendation_html(table, study)
          : "<p class=\"lead\">No step is recommended.</p>\n<p>Why? In short: " + escaped(reason) + ".</p>\n";
  const std::string doubt = has_answer && !study.advice->confirmed
                                ? "<p class=\"warning\">NOT CONFIRMED: the run that was to confirm this "
                                  "step missed what was asked for</p>\n"
                                : "";
  return "<div class=\"advice\">\n" + text + "</div>\n" + doubt + words_html(study);
}

}  // namespace jourdain::report
