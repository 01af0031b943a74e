#include "studies/advice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace jourdain::studies {

namespace {

/// Runs with steps of any length, compared after each one.
class Trials {
 public:
  Trials(const Flow<double>& flow, double sampling, const ReferenceSolution& reference)
      : flow_(flow), sampling_(sampling), reference_(reference) {}

  double sampling() const { return sampling_; }

  WorkPoint run(const Flow<double>& stepped, std::size_t method, double h) {
    const ReferenceSolution& at = at_steps(h);
    WorkPoint point = measure_errors(stepped, method, h, std::max(h, sampling_), at, false);
    if (&at != &reference_) point.largest.position += at.position_error;
    return point;
  }

  /// A run that is compared after each step. One that errs by more where the steps meet the reference needs no other.
  bool keeps(std::size_t method, double h, double tolerance) {
    const auto keep = [tolerance](const WorkPoint& point) {
      return point.finite && point.largest.position <= tolerance;
    };
    return keep(measure_errors(flow_, method, h, std::max(h, sampling_), reference_, false)) &&
           is_compared(h) && keep(run(flow_, method, h));
  }

  /// Time between comparisons.
  double compared(double h) {
    const ReferenceSolution& at = at_steps(h);
    const double block = std::max(h, sampling_);
    return block / double(std::gcd(std::lround(block / h), std::lround(block / at.interval)));
  }

 private:
  bool is_compared(double h) { return compared(h) < 1.001 * h; }

  /// The reference, or another solution where that has no points at multiples of h.
  const ReferenceSolution& at_steps(double h) {
    if (h > 0.999 * sampling_) return reference_;
    const long steps = std::lround(sampling_ / h), intervals = std::lround(sampling_ / reference_.interval);
    if (intervals % steps == 0) return reference_;
    if (const auto known = others_.find(steps); known == others_.end())
      others_.emplace(steps, reference_at_steps(flow_, reference_, sampling_, steps));
    const std::optional<ReferenceSolution>& other = others_.at(steps);
    return other ? *other : reference_;
  }

  const Flow<double>& flow_;
  double sampling_;
  const ReferenceSolution& reference_;
  std::map<long, std::optional<ReferenceSolution>> others_;  ///< by steps in a sampling
};

/// Of the steps up to twice as long of which whole numbers make the reference's time.
double longest_of_whole_intervals(const WorkPoint& good, double tolerance, Trials& trials,
                                  const ReferenceSolution& reference) {
  const auto intervals = static_cast<long>(reference.points.size() - 1);
  const double duration = reference.interval * static_cast<double>(intervals);
  const long enough = std::lround(duration / good.h);
  for (long count = enough / 2 + 1; count < enough; ++count) {
    if (intervals % count != 0) continue;
    const double h = duration / double(count);
    if (trials.keeps(good.method, h, tolerance)) return h;
  }
  return good.h;
}

/// Largest step below `longest` that keeps the tolerance: errors grow with h, so halve the range of step counts.
double longest_step(const WorkPoint& good, double tolerance, Trials& trials,
                    const ReferenceSolution& reference) {
  const double sampling = trials.sampling();
  if (good.h > 0.999 * sampling) return longest_of_whole_intervals(good, tolerance, trials, reference);
  long enough = std::lround(sampling / good.h), too_few = enough / 2;
  while (enough - too_few > std::max(1L, enough / 20)) {
    const long count = (enough + too_few) / 2;
    (trials.keeps(good.method, sampling / double(count), tolerance) ? enough : too_few) = count;
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
                                        Trials& trials, const ReferenceSolution& reference) {
  std::pair<std::size_t, double> best;
  double least = INFINITY, least_known = INFINITY;
  for (const WorkPoint* point : candidates) least_known = std::min(least_known, point->run_time);
  for (const WorkPoint* point : candidates) {
    if (point->run_time > 2 * least_known) continue;
    const double h = longest_step(*point, tolerance, trials, reference);
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
  Trials trials(flow, sampling, reference);
  if (question.tolerance) {
    std::tie(advice.method, advice.h) = cheapest(candidates, *question.tolerance, trials, reference);
  } else {
    const WorkPoint& best = **std::min_element(
        candidates.begin(), candidates.end(),
        [](const WorkPoint* a, const WorkPoint* b) { return a->largest.position < b->largest.position; });
    advice.method = best.method;
    advice.h = best.h;
  }
  const WorkPoint run = trials.run(flow, advice.method, advice.h);
  advice.error = run.largest;
  advice.compared = trials.compared(advice.h);
  Flow<double> holding = flow;
  holding.hold_inputs();
  const WorkPoint held = trials.run(holding, advice.method, advice.h);
  if (held.finite) advice.error_held = held.largest;
  advice.step_time =
      measure_step_times(flow.table(), flow.start(), held_inputs, advice.h)[advice.method].least;
  advice.run_time = advice.step_time / advice.h;
  advice.confirmed = run.finite && (!question.tolerance || run.largest.position <= *question.tolerance) &&
                     (!question.budget || advice.run_time * question.period <= *question.budget);
  return advice;
}

}  // namespace jourdain::studies
