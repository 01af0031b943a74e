#include "studies/study.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "model/coordinates.hpp"
#include "model/loop_kinds.hpp"
#include "studies/local_dynamics.hpp"
#include "studies/work.hpp"
#include "support/check.hpp"

namespace jourdain::studies {

namespace {

constexpr long kFewestIntervals = 4;
constexpr double kStepsForSources = 2;  ///< in 50 digits, for one step: truncation, and the run itself
constexpr double kLinear = 0.1;    ///< share of the error by which the parts may miss it in the linear regime
constexpr double kRegular = 1e-2;  ///< relative error above which no parts are computed

/// Of one step of each method in 50 digits, over `duration`.
double level_time(const jourdain_model_table& table, double h, double duration) {
  double step = 0;
  for (int m = 0; m < table.method_count; ++m) step += long_step_time(table.methods[m]);
  return step * duration / h;
}

const WorkPoint& point_of(const WorkPrecision& work, std::size_t method, double h) {
  for (const WorkPoint& point : work.points)
    if (point.method == method && std::fabs(point.h - h) < 1e-9 * h) return point;
  JD_CHECK(false, "no point of method {} at h = {}", method, h);
  return work.points.front();
}

/// Parts of the errors, from the longest step to shorter ones, as far as the budget allows.
std::vector<ErrorSources> study_sources(const Flow<double>& flow, const Flow<LongReal>& long_flow,
                                        const Study& study, const Progress& progress) {
  std::vector<ErrorSources> sources;
  const std::vector<Eigen::MatrixXd> transitions = transition_matrices(flow, study.reference.points);
  Budget budget(study.options.seconds);
  for (const double h : study.steps) {
    if (h > 1.001 * study.options.longest_step) continue;
    const double ratio = h / study.reference.interval;
    if (ratio < 0.99) break;
    budget.spend(kStepsForSources * level_time(flow.table(), h, study.judged));
    if (budget.is_over() && !sources.empty()) break;
    for (std::size_t m = 0; m < study.work.step_times.size(); ++m) {
      progress("error sources", std::clamp(1 - budget.left() / study.options.seconds, 0.0, 1.0));
      const WorkPoint& point = point_of(study.work, m, h);
      const bool regular = point.finite && point.relative_largest.position < kRegular &&
                           point.relative_largest.velocity < 10 * kRegular;
      if (!regular) continue;
      sources.push_back(error_sources(flow, long_flow, m, study.reference, transitions,
                                      static_cast<std::size_t>(std::lround(ratio))));
    }
  }
  std::stable_sort(sources.begin(), sources.end(),
                   [](const ErrorSources& a, const ErrorSources& b) { return a.method < b.method; });
  return sources;
}

/// Rounding at the steps that `study_sources` left out, as far as the budget allows.
std::vector<RoundingPoint> study_roundings(const Flow<double>& flow, const Flow<LongReal>& long_flow,
                                           const Study& study, const Progress& progress) {
  std::vector<RoundingPoint> points;
  double shortest = INFINITY;
  for (const ErrorSources& source : study.sources) shortest = std::min(shortest, source.h);
  Budget budget(study.options.seconds / 2);
  for (const double h : study.steps) {
    if (h > 0.99 * shortest) continue;
    budget.spend(level_time(flow.table(), h, study.judged));
    if (budget.is_over() && !points.empty()) break;
    for (std::size_t m = 0; m < study.work.step_times.size(); ++m) {
      progress("rounding", std::clamp(1 - 2 * budget.left() / study.options.seconds, 0.0, 1.0));
      const WorkPoint& point = point_of(study.work, m, h);
      if (point.finite && point.relative_largest.position < kRegular)
        points.push_back({m, h, rounding_error(flow, long_flow, m, h, std::lround(study.judged / h))});
    }
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const RoundingPoint& a, const RoundingPoint& b) { return a.method < b.method; });
  return points;
}

/// Slope of log(values) over log(h) by least squares; none with fewer than two positive values.
struct Line {
  double slope = 0, offset = 0;  ///< log(value) = offset + slope log(h)
};
std::optional<Line> fitted(const std::vector<double>& h, const std::vector<double>& values) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (!(values[i] > 0)) continue;
    const double x = std::log(h[i]), y = std::log(values[i]);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double determinant = n * sxx - sx * sx;
  if (n < 2 || !(determinant > 0)) return {};
  const double slope = (n * sxy - sx * sy) / determinant;
  return Line{slope, (sy - slope * sx) / n};
}

/// The last entries, at most `count`.
std::vector<double> tail(const std::vector<double>& values, std::size_t count) {
  return {values.end() - static_cast<std::ptrdiff_t>(std::min(count, values.size())), values.end()};
}

SourceSummary summarise(std::size_t method, const Study& study) {
  SourceSummary summary;
  summary.method = method;
  std::vector<double> h, truncation, propagated, rounding_h, rounding;
  for (const ErrorSources& source : study.sources) {
    if (source.method != method) continue;
    h.push_back(source.h);
    truncation.push_back(source.truncation.position);
    propagated.push_back(source.propagated.position);
    rounding_h.push_back(source.h);
    rounding.push_back(source.rounding.position);
    const bool linear = source.difference.position <= kLinear * source.measured.position;
    if (linear && !summary.linear_until) summary.linear_until = source.h;
    if (!linear) summary.linear_until.reset();
  }
  for (const RoundingPoint& point : study.roundings) {
    if (point.method != method) continue;
    rounding_h.push_back(point.h);
    rounding.push_back(point.rounding.position);
  }
  constexpr double kReach = 100;    // how far beyond the steps tried the lines are trusted to cross
  constexpr std::size_t kTail = 3;  // the shortest steps: asymptotic
  const auto truncation_line = fitted(tail(h, kTail), tail(truncation, kTail));
  const auto propagated_line = fitted(tail(h, kTail), tail(propagated, kTail));
  const auto rounding_line = fitted(rounding_h, rounding);
  if (truncation_line) summary.truncation_slope = truncation_line->slope;
  if (propagated_line) summary.propagation_slope = propagated_line->slope;
  if (rounding_line) summary.rounding_slope = rounding_line->slope;
  if (propagated_line && rounding_line && propagated_line->slope > rounding_line->slope + 0.5) {
    const double crossing =
        (rounding_line->offset - propagated_line->offset) / (propagated_line->slope - rounding_line->slope);
    const double step = std::exp(crossing);
    if (step > rounding_h.back() / kReach && step < h.front() * kReach) {
      summary.rounding_step = step;
      summary.rounding_step_extrapolated = step < rounding_h.back() || step > h.front();
    }
  }
  return summary;
}

/// Those at which the classical Runge-Kutta method is stable.
std::vector<double> steps_within_limit(const Study& study, const jourdain_model_table& table) {
  double limit = INFINITY;
  for (const MethodLimit& l : study.stability.limits)
    if (std::string_view(table.methods[l.method].name) == "rk4" && l.h > 0) limit = largest_stable_step(l);
  std::vector<double> steps;
  for (const double h : study.steps)
    if (h < limit) steps.push_back(h);
  return steps;
}

/// The longer steps at which no method is right to a tenth.
void leave_out_useless_steps(Study& study) {
  constexpr double kUseful = 0.1;
  const auto useful = [&](double h) {
    return std::any_of(study.work.points.begin(), study.work.points.end(), [h](const WorkPoint& p) {
      return p.h == h && p.finite && p.relative_largest.position < kUseful;
    });
  };
  while (study.steps.front() > 1.001 * study.options.longest_step && !useful(study.steps.front())) {
    const double h = study.steps.front();
    study.steps.erase(study.steps.begin());
    std::erase_if(study.work.points, [h](const WorkPoint& p) { return p.h == h; });
  }
  mark_pareto_front(study.work.points);
}

/// The first of the shortest steps' ends at which some rod's length is not positive.
std::optional<double> without_length(const model::Mechanism& mechanism, const std::vector<double>& parameters,
                                     const Study& study) {
  const bool any =
      std::ranges::any_of(mechanism.loops, [](const model::Loop& loop) { return loop_kind(loop).is_bar(); });
  const double h = study.steps.back();
  for (long k = 1; any && static_cast<double>(k) * h <= study.options.duration; ++k)
    if (model::bar_without_length(mechanism, parameters, static_cast<double>(k) * h))
      return static_cast<double>(k) * h;
  return {};
}

}  // namespace

Study run_study(const model::Mechanism& mechanism, const model::Tangent& tangent,
                const std::vector<double>& parameters, const Flow<double>& given,
                const Flow<LongReal>* long_flow, const EmittedFreeBodies* free, const StudyOptions& options,
                const Progress& progress) {
  Study study;
  study.options = options;
  study.has_kinks =
      given.inputs().has_kinks() || model::any_force_element(mechanism, [](auto element) {
        return std::ranges::any_of(element.expressions(), [](const auto* e) { return e->has_kinks(); });
      });
  Flow<double> flow = given;
  if (options.hold_inputs) flow.hold_inputs();
  for (int i = 0; i <= options.halvings; ++i) study.steps.push_back(std::ldexp(options.longest_step, -i));
  const double sampling = options.longest_step;
  const long wanted =
      std::max(kFewestIntervals, static_cast<long>(std::ceil(options.duration / sampling - 1e-9)));
  study.options.duration = static_cast<double>(wanted) * sampling;
  study.longer = study.options.duration - options.duration;

  study.untrusted =
      first_untrusted(flow, study.steps.back(), study.options.duration, study.options.most_open);
  if (const std::optional<double> from = without_length(mechanism, parameters, study);
      from && !(study.untrusted && study.untrusted->from <= *from))
    study.untrusted = Untrusted{*from, "the length of a rod is no longer positive"};
  study.reference = solve_reference(flow, long_flow, options.reference, sampling, wanted, options.halvings,
                                    options.seconds, progress);
  study.judged = study.reference.points.back().t - study.reference.points.front().t;
  progress("nearby trajectories", 0);
  study.divergence = measure_divergence(flow, study.reference.points, sampling,
                                        trajectory_rate(flow, study.reference, tangent));
  std::vector<double> longer = longer_steps(study.reference, sampling);
  std::erase_if(longer, [&](double h) { return !allows_step(options.question, h); });
  study.steps.insert(study.steps.begin(), longer.begin(), longer.end());
  const std::vector<double> held = flow.inputs().at(0.0);
  study.work = study_work_precision(flow, study.steps, sampling, study.reference, options.conserves_energy,
                                    held, progress);
  if (options.question.tolerance) {
    const std::vector<double> shorter =
        go_on_to_shorter_steps(study.work, study.steps.back(), *options.question.tolerance, flow, sampling,
                               study.reference, options.conserves_energy, options.seconds, progress);
    study.steps.insert(study.steps.end(), shorter.begin(), shorter.end());
  }
  leave_out_useless_steps(study);
  const bool parts = !study.reference.exact.empty() && long_flow && !options.hold_inputs;
  if (parts) {
    study.sources = study_sources(flow, *long_flow, study, progress);
    study.roundings = study_roundings(flow, *long_flow, study, progress);
    for (std::size_t m = 0; m < study.work.step_times.size(); ++m)
      study.summaries.push_back(summarise(m, study));
  }
  study.stability =
      study_stability(flow, study.reference, tangent, options.conserves_energy, options.seconds, progress);
  if (options.forms)
    study.forms = study_forms(mechanism, parameters, flow, free, steps_within_limit(study, flow.table()),
                              sampling, study.reference, options.seconds / 4, progress);
  if (long_flow)
    study.extremes =
        study_extremes(mechanism, tangent, parameters, flow, *long_flow, study.reference, progress);
  if (!study.untrusted && (options.question.tolerance || options.question.budget)) {
    progress("recommendation", 0);
    study.advice = advise(options.question, study.work, flow, sampling, study.reference, held,
                          {study.stability.limits, std::ranges::max(study.divergence.growth)});
    if (study.advice)
      study.alternatives = study_alternatives(flow, *study.advice, options.question.tolerance, sampling,
                                              study.reference, options.seconds / 16, progress);
  }
  study.touches = study_touches(flow, options.touches, study.work, study.judged);
  study.loops = study_loops(flow, study.work, study.advice ? &*study.advice : nullptr, study.judged);
  progress("", 1);
  return study;
}

}  // namespace jourdain::studies
