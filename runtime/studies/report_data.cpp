// A study as CSV and JSON.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "studies/report.hpp"

namespace jourdain::studies {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json norms(const ErrorNorms& errors) {
  return {{"position", number(errors.position)}, {"velocity", number(errors.velocity)}};
}

std::string work_precision_csv(const jourdain_model_table& table, const Study& study) {
  std::string text =
      "method,step_s,finite,end_position_error,end_velocity_error,largest_position_error,largest_velocity_"
      "error,"
      "relative_end_position_error,relative_end_velocity_error,relative_largest_position_error,"
      "relative_largest_velocity_error,energy_drift_J,run_time_per_simulated_second_s,real_time_factor,"
      "operations_per_step,pareto\n";
  for (const WorkPoint& p : study.work.points)
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", table.methods[p.method].name, p.h,
                    p.finite ? 1 : 0, p.end.position, p.end.velocity, p.largest.position, p.largest.velocity,
                    p.relative_end.position, p.relative_end.velocity, p.relative_largest.position,
                    p.relative_largest.velocity, p.energy_drift ? fmt::format("{}", *p.energy_drift) : "",
                    p.run_time, 1 / p.run_time, table.methods[p.method].operations, p.pareto ? 1 : 0);
  return text;
}

std::string error_sources_csv(const jourdain_model_table& table, const Study& study) {
  std::string text =
      "method,step_s,truncation_position,truncation_velocity,propagated_position,propagated_velocity,"
      "rounding_position,rounding_velocity,predicted_position,predicted_velocity,measured_position,measured_"
      "velocity,"
      "difference_position,difference_velocity\n";
  for (const ErrorSources& s : study.sources)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", table.methods[s.method].name, s.h,
                        s.truncation.position, s.truncation.velocity, s.propagated.position,
                        s.propagated.velocity, s.rounding.position, s.rounding.velocity, s.predicted.position,
                        s.predicted.velocity, s.measured.position, s.measured.velocity, s.difference.position,
                        s.difference.velocity);
  return text;
}

std::string first_kind_csv(const Study& study) {
  std::string text =
      "form,states,unknowns,step_s,finite,position_error_m,angle_error_rad,drift,rate_drift,step_time_s\n";
  for (const FormCurve& curve : study.forms)
    for (const FormPoint& p : curve.points)
      text +=
          fmt::format("\"{}\",{},{},{},{},{},{},{},{},{}\n", curve.form, curve.states, curve.unknowns, p.h,
                      p.finite ? 1 : 0, p.position_error, p.angle_error, p.drift, p.rate_drift, p.step_time);
  return text;
}

Json methods_json(const jourdain_model_table& table, const Study& study) {
  Json methods = Json::array();
  for (std::size_t m = 0; m < study.work.step_times.size(); ++m) {
    const jourdain_method& method = table.methods[m];
    const StepTime& time = study.work.step_times[m];
    Json entry = {{"name", method.name},
                  {"order", method.order},
                  {"measured_order", number(study.work.orders[m])},
                  {"evaluations", method.evaluations},
                  {"implicit", method.implicit != 0},
                  {"operations", method.operations},
                  {"step_time_s", time.least},
                  {"step_time_quartiles_s", {time.lower_quartile, time.upper_quartile}}};
    for (const SourceSummary& s : study.summaries)
      if (s.method == m)
        entry["sources"] = {{"truncation_slope", number(s.truncation_slope)},
                            {"propagation_slope", number(s.propagation_slope)},
                            {"rounding_slope", number(s.rounding_slope)},
                            {"rounding_dominates_below_s", number(s.rounding_step)},
                            {"rounding_dominates_extrapolated", s.rounding_step_extrapolated},
                            {"linear_until_s", number(s.linear_until)}};
    methods.push_back(std::move(entry));
  }
  return methods;
}

Json points_json(const jourdain_model_table& table, const Study& study) {
  Json points = Json::array();
  for (const WorkPoint& p : study.work.points) {
    Json entry = {{"method", table.methods[p.method].name}, {"step_s", p.h}, {"finite", p.finite}};
    if (p.finite) {
      entry["end"] = norms(p.end);
      entry["largest"] = norms(p.largest);
      entry["relative_end"] = norms(p.relative_end);
      entry["relative_largest"] = norms(p.relative_largest);
      if (p.energy_drift) entry["energy_drift_J"] = number(*p.energy_drift);
    }
    entry["run_time_per_simulated_second_s"] = p.run_time;
    entry["pareto"] = p.pareto;
    points.push_back(std::move(entry));
  }
  return points;
}

Json sources_json(const jourdain_model_table& table, const Study& study) {
  Json sources = Json::array();
  for (const ErrorSources& s : study.sources)
    sources.push_back({{"method", table.methods[s.method].name},
                       {"step_s", s.h},
                       {"truncation", norms(s.truncation)},
                       {"propagated", norms(s.propagated)},
                       {"rounding", norms(s.rounding)},
                       {"predicted", norms(s.predicted)},
                       {"measured", norms(s.measured)},
                       {"difference", norms(s.difference)}});
  return sources;
}

Json roundings_json(const jourdain_model_table& table, const Study& study) {
  Json points = Json::array();
  for (const RoundingPoint& p : study.roundings)
    points.push_back(
        {{"method", table.methods[p.method].name}, {"step_s", p.h}, {"rounding", norms(p.rounding)}});
  return points;
}

/// 0 where no step is stable, null where nothing is predicted.
Json limit_json(const jourdain_model_table& table, const MethodLimit& limit) {
  Json entry = {{"method", table.methods[limit.method].name},
                {"predicted_s", limit.predicts ? number(limit.h) : Json()}};
  if (limit.predicts) {
    const char* kinds[] = {"damped", "undamped", "growing"};
    entry["time_s"] = limit.time;
    entry["mode_per_s"] = {limit.mode.real(), limit.mode.imag()};
    entry["mode_is"] = kinds[static_cast<int>(limit.kind)];
    entry["fast"] = limit.fast;
  }
  if (limit.observed)
    entry["observed"] = {
        {"step_s", limit.observed->h}, {"start_s", limit.observed->start}, {"steps", limit.observed->steps}};
  if (limit.stable_until) entry["observed_none_up_to_s"] = *limit.stable_until;
  return entry;
}

Json extremes_json(const Study& study) {
  Json sweeps = Json::array();
  for (const ExtremeSweep& sweep : study.extremes) {
    Json points = Json::array();
    for (const ExtremePoint& p : sweep.points)
      points.push_back({{"factor", p.factor},
                        {"backward_u", number(p.backward)},
                        {"forward_u", number(p.forward)},
                        {"finite", p.finite},
                        {"closes", p.closes}});
    sweeps.push_back({{"quantity", sweep.quantity}, {"points", points}});
  }
  return sweeps;
}

Json stability_json(const jourdain_model_table& table, const Study& study) {
  const Stability& s = study.stability;
  Json limits = Json::array(), owners = Json::array(), points = Json::array();
  for (const MethodLimit& limit : s.limits) limits.push_back(limit_json(table, limit));
  for (const CoordinateShare& owner : s.owners)
    owners.push_back({{"coordinate", owner.name}, {"share", owner.share}});
  for (const StabilityPoint& point : s.points) {
    Json eigenvalues = Json::array();
    for (const auto& mu : point.eigenvalues) eigenvalues.push_back({mu.real(), mu.imag()});
    points.push_back({{"time_s", point.time}, {"eigenvalues_per_s", eigenvalues}});
  }
  return {
      {"trajectory_rate_per_s", s.rate},
      {"damps", s.damps},
      {"stiffness", s.stiffness},
      {"limits", limits},
      {"fastest_mode", {{"mode_per_s", {s.fastest.real(), s.fastest.imag()}}, {"time_s", s.fastest_time}}},
      {"fastest_mode_belongs_to", owners},
      {"transient_growth", number(s.transient_growth)},
      {"points", points},
      {"remarks", stability_remarks(table, study)}};
}

Json touches_json(const jourdain_model_table& table, const Study& study) {
  if (!study.touches) return nullptr;
  Json elements = Json::array();
  for (std::size_t i = 0; i < study.touches->runs.size(); ++i) {
    const TouchFacts& element = study.options.touches[i];
    const TouchRun& run = study.touches->runs[i];
    Json json = {{"name", element.name},           {"unit", element.unit},
                 {"deepest", run.deepest},         {"at_s", run.at},
                 {"deep_at_start", run.start},     {"share", run.share},
                 {"stiffness", element.stiffness}, {"exponent", element.exponent}};
    if (study.options.penetration && run.deepest > *study.options.penetration &&
        run.start <= *study.options.penetration) {
      const Stiffening needed = stiffening(element, run.deepest, *study.options.penetration);
      json["stiffness_within_depth"] = needed.stiffness;
      json["steps_within_depth"] = needed.step_share;
    }
    elements.push_back(std::move(json));
  }
  return {{"method", table.methods[study.touches->method].name},
          {"h_s", study.touches->h},
          {"elements", elements}};
}

Json loops_json(const ReportHead& head, const jourdain_model_table& table, const Study& study) {
  Json runs = Json::array();
  for (const LoopRun& run : study.loops)
    runs.push_back({{"method", table.methods[run.method].name},
                    {"step_s", run.h},
                    {"steps", run.steps},
                    {"finite", run.finite},
                    {"largest_residual_m", number(run.open.position)},
                    {"largest_rate_m_per_s", number(run.open.velocity)}});
  return {{"closed", head.loops}, {"each_step_ends_with", head.closing}, {"runs", runs}};
}

Json forms_json(const Study& study) {
  Json forms = Json::array();
  for (const FormCurve& curve : study.forms) {
    Json points = Json::array();
    for (const FormPoint& p : curve.points)
      points.push_back({{"step_s", p.h},
                        {"finite", p.finite},
                        {"position_error_m", number(p.position_error)},
                        {"angle_error_rad", number(p.angle_error)},
                        {"drift", number(p.drift)},
                        {"rate_drift", number(p.rate_drift)},
                        {"step_time_s", p.step_time}});
    forms.push_back(
        {{"form", curve.form}, {"states", curve.states}, {"unknowns", curve.unknowns}, {"points", points}});
  }
  return forms;
}

Json alternatives_json(const jourdain_model_table& table, const Study& study) {
  const Alternatives& a = study.alternatives;
  Json rows = Json::array();
  for (const Alternative& row : a.rows) {
    Json entry = {{"integrator", row.name}, {"finished", row.finished}};
    if (row.finished)
      entry.update({{"relative_tolerance", number(row.tolerance)},
                    {"step_s", number(row.h)},
                    {"largest_error", norms(row.error)},
                    {"keeps_error", row.keeps},
                    {"steps", row.steps},
                    {"calls", row.calls},
                    {"worst_step_calls", row.worst_calls},
                    {"run_time_per_simulated_second_s", row.run_time.least},
                    {"run_time_quartiles_s", {row.run_time.lower_quartile, row.run_time.upper_quartile}},
                    {"ratio", number(time_ratio(a, row))}});
    rows.push_back(std::move(entry));
  }
  return {{"error", a.error}, {"rows", rows}, {"remarks", alternatives_remarks(table, study)}};
}

Json advice_json(const jourdain_model_table& table, const Study& study) {
  const Question& question = study.options.question;
  Json result = {{"tolerance", number(question.tolerance)},
                 {"budget_s", number(question.budget)},
                 {"period_s", question.period}};
  if (!study.advice) return result;
  const Advice& a = *study.advice;
  result["method"] = table.methods[a.method].name;
  result["step_s"] = a.h;
  result["largest_error"] = norms(a.error);
  result["compared_every_s"] = a.compared;
  result["inputs_held"] = study.options.hold_inputs;
  if (a.error_held) result["largest_error_with_inputs_held"] = norms(*a.error_held);
  result["step_time_s"] = a.step_time;
  result["run_time_per_simulated_second_s"] = a.run_time;
  result["confirmed"] = a.confirmed;
  return result;
}

}  // namespace

std::vector<support::FileText> report_csv(const ReportHead& head, const jourdain_model_table& table,
                                          const Study& study) {
  std::vector<support::FileText> files = {{"work_precision.csv", work_precision_csv(table, study)}};
  if (!study.sources.empty()) files.push_back({"error_sources.csv", error_sources_csv(table, study)});
  if (!study.stability.points.empty())
    files.push_back({"stability.csv", stability_csv(table, study.stability)});
  if (!study.extremes.empty()) files.push_back({"extremes.csv", extremes_csv(study.extremes)});
  if (!study.forms.empty()) files.push_back({"first_kind.csv", first_kind_csv(study)});
  if (!study.alternatives.rows.empty()) files.push_back({"alternatives.csv", alternatives_csv(study)});
  if (!study.loops.empty()) files.push_back({"loops.csv", loops_csv(head, table, study)});
  return files;
}

std::vector<std::string> report_csv_names() {
  return {"work_precision.csv", "error_sources.csv", "stability.csv", "extremes.csv",
          "first_kind.csv",     "alternatives.csv",  "loops.csv"};
}

std::string report_json(const ReportHead& head, const jourdain_model_table& table, const Study& study) {
  const Json report = {{"generator", head.generator},
                       {"name", head.name},
                       {"model", head.path},
                       {"sha256", head.sha256},
                       {"number_type", head.real},
                       {"compiler", head.compiler},
                       {"inputs", head.scenario},
                       {"duration_s", study.options.duration},
                       {"judged_s", study.judged},
                       {"reference",
                        {{"method", study.reference.method},
                         {"error", study.reference.error},
                         {"interval_s", study.reference.interval}}},
                       {"divergence",
                        {{"growth", number(study.divergence.growth.back())},
                         {"exponent_per_s", number(study.divergence.exponent)}}},
                       {"remarks", remarks(table, study)},
                       {"methods", methods_json(table, study)},
                       {"points", points_json(table, study)},
                       {"error_sources", sources_json(table, study)},
                       {"rounding", roundings_json(table, study)},
                       {"stability", stability_json(table, study)},
                       {"loops", loops_json(head, table, study)},
                       {"one_sided_elements", touches_json(table, study)},
                       {"extremes", extremes_json(study)},
                       {"first_kind", forms_json(study)},
                       {"alternatives", alternatives_json(table, study)},
                       {"recommendation", advice_json(table, study)}};
  return report.dump(1) + "\n";
}

}  // namespace jourdain::studies
