#include <fmt/format.h>

#include <algorithm>

#include "studies/report.hpp"

namespace jourdain::studies {

namespace {

constexpr const char* kAlternativesRow = "  {:<23} {:>12} {:>9} {:>7} {:>8} {:>10} {:>9} {:>15} {:>6}\n";

std::string setting_text(const Alternative& row) {
  if (row.h) return "h = " + time_text(*row.h);
  return row.tolerance ? fmt::format("rtol {:.1e}", *row.tolerance) : "-";
}

std::string per_millisecond(double run_time) { return fmt::format("{:.3g}", run_time * 1e6 * 1e-3); }

}  // namespace

std::vector<std::string> alternatives_head() {
  return {"integrator", "own step",  "error",     "steps", "calls",
          "worst step", "us per ms", "quartiles", "ratio"};
}

std::vector<std::vector<std::string>> alternatives_rows(const Study& study) {
  std::vector<std::vector<std::string>> rows;
  for (const Alternative& row : study.alternatives.rows) {
    if (!row.finished) {
      rows.push_back({row.name, "-", "fails", "-", "-", "-", "-", "-", "-"});
      continue;
    }
    rows.push_back(
        {row.name, setting_text(row), fmt::format("{:.1e}{}", row.error.position, row.keeps ? "" : " !"),
         fmt::format("{}", row.steps), fmt::format("{}", row.calls), fmt::format("{}", row.worst_calls),
         per_millisecond(row.run_time.least),
         per_millisecond(row.run_time.lower_quartile) + " " + per_millisecond(row.run_time.upper_quartile),
         fmt::format("{:.3g}", time_ratio(study.alternatives, row))});
  }
  return rows;
}

std::vector<std::string> alternatives_remarks(const jourdain_model_table& table, const Study& study) {
  const Alternatives& a = study.alternatives;
  if (a.rows.empty()) return {};
  std::vector<std::string> list = {
      fmt::format(
          "the first row is the recommended step. All keep within {:.2g} (rad, m), the others compared every "
          "{} over {}: "
          "adaptive integrators at the loosest relative tolerance (thirds of decades; absolute a "
          "tenth of it) "
          "that does. They choose their steps freely and are interpolated",
          a.error, time_text(a.compared), time_text(study.judged)),
      "steps and calls of the right-hand side are exact. Worst step: calls in one single step, with rejected "
      "attempts, Jacobians by differences and the start; real time must allow for it in every step. Run time "
      "per "
      "ms of motion is measured, whole runs in turns: least, and quartiles; ratio: over the first row's"};
  if (table.parts == 1 && table.unit_roundoff > 0x1p-53)
    list.push_back(
        "the adaptive integrators compute in double, on the right-hand side in the shorter numbers");
  const auto misses = [](const Alternative& row) { return !row.keeps && row.finished; };
  if (std::any_of(a.rows.begin(), a.rows.end(), misses))
    list.push_back(
        "!: NOT at equal error: with the work allowed it comes no closer, and its time is for the error "
        "stated");
  if (std::any_of(a.rows.begin() + 1, a.rows.end(), [](const Alternative& row) { return row.h.has_value(); }))
    list.push_back(
        "semi-implicit Euler has the default step of MuJoCo, 2 ms, or the next to it that divides the "
        "time compared; MuJoCo also treats joint damping implicitly");
  if (study.advice && table.methods[study.advice->method].implicit)
    list.push_back(
        "calls of the recommended step are of the residual; it also forms and factors its matrix once "
        "per step, which its time holds");
  if (table.input_count > 0)
    list.push_back(
        "the integrators sample the inputs as functions of time, in the same way; that is part of all "
        "times");
  return list;
}

std::string alternatives_text(const jourdain_model_table& table, const Study& study) {
  if (study.alternatives.rows.empty()) return "";
  const auto line = [](const std::vector<std::string>& c) {
    return fmt::format(kAlternativesRow, c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]);
  };
  std::string text =
      "\n  other integrators on the same right-hand side, at equal error\n" + line(alternatives_head());
  for (const std::vector<std::string>& row : alternatives_rows(study)) text += line(row);
  for (const std::string& remark : alternatives_remarks(table, study)) text += wrapped(remark);
  return text;
}

std::string alternatives_csv(const Study& study) {
  std::string text =
      "integrator,relative_tolerance,step_s,finished,keeps_error,largest_position_error,largest_velocity_"
      "error,steps,"
      "calls,worst_step_calls,run_time_per_simulated_second_s,lower_quartile_s,upper_quartile_s,ratio\n";
  const auto optional = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "";
  };
  for (const Alternative& r : study.alternatives.rows)
    text +=
        fmt::format("\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{}\n", r.name, optional(r.tolerance),
                    optional(r.h), r.finished ? 1 : 0, r.keeps ? 1 : 0, r.error.position, r.error.velocity,
                    r.steps, r.calls, r.worst_calls, r.run_time.least, r.run_time.lower_quartile,
                    r.run_time.upper_quartile, time_ratio(study.alternatives, r));
  return text;
}

}  // namespace jourdain::studies
