#include "studies/advice.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace jourdain::studies {

namespace {

/// Of the steps up to twice as long of which whole numbers make the reference's time.
double longest_of_whole_intervals(const WorkPoint& good, double tolerance, const Flow<double>& flow,
                                  const ReferenceSolution& reference) {
  const auto intervals = static_cast<long>(reference.points.size() - 1);
  const double duration = reference.interval * static_cast<double>(intervals);
  const long enough = std::lround(duration / good.h);
  for (long count = enough / 2 + 1; count < enough; ++count) {
    if (intervals % count != 0) continue;
    const double h = duration / double(count);
    const WorkPoint tried = measure_errors(flow, good.method, h, h, reference, false);
    if (tried.finite && tried.largest.position <= tolerance) return h;
  }
  return good.h;
}

/// Largest step below `longest` that keeps the tolerance: errors grow with h, so halve the range of step counts.
double longest_step(const WorkPoint& good, double tolerance, const Flow<double>& flow, double sampling,
                    const ReferenceSolution& reference) {
  if (good.h > 0.999 * sampling) return longest_of_whole_intervals(good, tolerance, flow, reference);
  long enough = std::lround(sampling / good.h), too_few = enough / 2;
  while (enough - too_few > std::max(1L, enough / 20)) {
    const long count = (enough + too_few) / 2;
    const WorkPoint tried =
        measure_errors(flow, good.method, sampling / double(count), sampling, reference, false);
    const bool keeps = tried.finite && tried.largest.position <= tolerance;
    (keeps ? enough : too_few) = count;
  }
  return sampling / double(enough);
}

bool is_whole(double x) { return std::fabs(x - std::round(x)) < 1e-9 * x; }

bool answers(const Question& question, const WorkPoint& point) {
  if (!point.finite) return false;
  if (question.tolerance) return point.largest.position <= *question.tolerance;
  return point.run_time * question.period <= *question.budget && is_whole(question.period / point.h);
}

/// Each method's point that answers best.
std::vector<const WorkPoint*> best_points(const Question& question, const std::vector<WorkPoint>& points) {
  std::vector<const WorkPoint*> list;
  for (const WorkPoint& point : points) {
    if (!answers(question, point)) continue;
    if (list.empty() || list.back()->method != point.method) list.push_back(&point);
    const bool better = question.tolerance ? point.run_time < list.back()->run_time
                                           : point.largest.position < list.back()->largest.position;
    if (better) list.back() = &point;
  }
  return list;
}

/// The cheapest of the methods, each with its longest step. A step can become up to twice as long.
std::pair<std::size_t, double> cheapest(const std::vector<const WorkPoint*>& candidates, double tolerance,
                                        const Flow<double>& flow, double sampling,
                                        const ReferenceSolution& reference) {
  std::pair<std::size_t, double> best;
  double least = INFINITY, least_known = INFINITY;
  for (const WorkPoint* point : candidates) least_known = std::min(least_known, point->run_time);
  for (const WorkPoint* point : candidates) {
    if (point->run_time > 2 * least_known) continue;
    const double h = longest_step(*point, tolerance, flow, sampling, reference);
    const double run_time = point->run_time * point->h / h;
    if (run_time >= least) continue;
    least = run_time;
    best = {point->method, h};
  }
  return best;
}

}  // namespace

std::optional<Advice> advise(const Question& asked, const WorkPrecision& study, const Flow<double>& flow,
                             double sampling, const ReferenceSolution& reference,
                             const std::vector<double>& held_inputs) {
  Question question = asked;
  if (question.tolerance) *question.tolerance -= reference.position_error;
  const std::vector<const WorkPoint*> candidates = best_points(question, study.points);
  if (candidates.empty()) return {};
  Advice advice;
  if (question.tolerance) {
    std::tie(advice.method, advice.h) = cheapest(candidates, *question.tolerance, flow, sampling, reference);
  } else {
    const WorkPoint& best = **std::min_element(
        candidates.begin(), candidates.end(),
        [](const WorkPoint* a, const WorkPoint* b) { return a->largest.position < b->largest.position; });
    advice.method = best.method;
    advice.h = best.h;
  }
  const double compared = std::max(advice.h, sampling);
  const WorkPoint run = measure_errors(flow, advice.method, advice.h, compared, reference, false);
  advice.error = run.largest;
  Flow<double> holding = flow;
  holding.hold_inputs();
  const WorkPoint held = measure_errors(holding, advice.method, advice.h, compared, reference, false);
  if (held.finite) advice.error_held = held.largest;
  advice.step_time =
      measure_step_times(flow.table(), flow.start(), held_inputs, advice.h)[advice.method].least;
  advice.run_time = advice.step_time / advice.h;
  advice.confirmed = run.finite && (!question.tolerance || run.largest.position <= *question.tolerance) &&
                     (!question.budget || advice.run_time * question.period <= *question.budget);
  return advice;
}

}  // namespace jourdain::studies
