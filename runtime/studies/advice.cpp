#include "studies/advice.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>

namespace jourdain::studies {

namespace {

bool is_unstable(const MotionFacts& facts, std::size_t method, double h) {
  return !facts.limits.empty() && is_beyond(facts.limits[method], h);
}

/// Runs with steps of any length, compared after each one.
class Trials {
 public:
  Trials(const Flow<double>& flow, double sampling, const ReferenceSolution& reference,
         const MotionFacts& facts, const Question& question)
      : flow_(flow), sampling_(sampling), reference_(reference), facts_(facts), question_(question) {}

  double sampling() const { return sampling_; }

  WorkPoint run(const Flow<double>& stepped, std::size_t method, double h) {
    const ReferenceSolution& at = at_steps(h);
    WorkPoint point = measure_errors(stepped, method, h, std::max(h, sampling_), at, false);
    if (&at != &reference_) point.largest.position += at.position_error;
    return point;
  }

  /// A run that is compared after each step. One that errs by more where the steps meet the reference needs no other.
  bool keeps(std::size_t method, double h, double tolerance) {
    if (is_unstable(facts_, method, h) || !allows_step(question_, h)) return false;
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
  const MotionFacts& facts_;
  const Question& question_;
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

/// Whether steps a little shorter keep it, too, so that it is not by luck.
bool keeps_beside(std::size_t method, long count, double tolerance, Trials& trials) {
  for (const long more : {1L, std::max(2L, count / 200)})
    if (!trials.keeps(method, trials.sampling() / double(count + more), tolerance)) return false;
  return true;
}

/// Largest step below `longest` that keeps the tolerance: errors grow with h, so halve the range of step counts.
double longest_step(const WorkPoint& good, double tolerance, Trials& trials,
                    const ReferenceSolution& reference) {
  const double sampling = trials.sampling();
  if (good.h > 0.999 * sampling) return longest_of_whole_intervals(good, tolerance, trials, reference);
  const long known = std::lround(sampling / good.h);
  long enough = known, too_few = enough / 2;
  while (enough - too_few > std::max(1L, enough / 20)) {
    const long count = (enough + too_few) / 2;
    (trials.keeps(good.method, sampling / double(count), tolerance) ? enough : too_few) = count;
  }
  while (enough < known && !keeps_beside(good.method, enough, tolerance, trials))
    enough = std::min(known, enough + std::max(1L, enough / 20));
  return sampling / double(enough);
}

/// By how much rounding alone may be off after one step, rad or m.
double rounding_of_a_step(const Flow<double>& flow, const ReferenceSolution& reference,
                          const MotionFacts& facts) {
  double largest = 1;
  for (const Point<double>& point : reference.points)
    for (std::size_t i = 0; i < flow.position_count(); ++i)
      largest = std::max(largest, std::fabs(point.x[i]));
  return flow.table().unit_roundoff * largest * facts.growth;
}

/// Points that miss the tolerance by more than rounding and the reference can be off by; none with a budget.
std::vector<WorkPoint> points_that_miss(const Question& question, const WorkPrecision& study,
                                        const Flow<double>& flow, const ReferenceSolution& reference,
                                        const MotionFacts& facts) {
  std::vector<WorkPoint> list;
  if (!question.tolerance) return list;
  const double known = std::max(*question.tolerance, reference.position_error);
  const double rounding = rounding_of_a_step(flow, reference, facts);
  std::copy_if(
      study.points.begin(), study.points.end(), std::back_inserter(list), [&](const WorkPoint& point) {
        return !point.finite || point.largest.position > std::max(known, rounding * study.duration / point.h);
      });
  return list;
}

/// Whether `a` answers better than `b`.
bool is_better(const Question& question, const WorkPoint& a, const WorkPoint& b) {
  return question.tolerance ? a.run_time < b.run_time : a.largest.position < b.largest.position;
}

/// Each method's point that answers best; one that holds by luck has a shorter step that misses.
std::vector<const WorkPoint*> best_points(const Question& question, const std::vector<WorkPoint>& points,
                                          const std::vector<WorkPoint>& missing, const MotionFacts& facts) {
  std::vector<const WorkPoint*> list;
  for (const WorkPoint& point : points) {
    const bool by_luck = std::any_of(missing.begin(), missing.end(), [&point](const WorkPoint& other) {
      return other.method == point.method && other.h < point.h;
    });
    if (by_luck || !keeps_within(question, point) || is_unstable(facts, point.method, point.h) ||
        (question.budget && !divides_period(question, point.h)))
      continue;
    if (list.empty() || list.back()->method != point.method) list.push_back(&point);
    if (is_better(question, point, *list.back())) list.back() = &point;
  }
  return list;
}

/// The best that is not of `method`.
std::optional<WorkPoint> best_of_others(const Question& question,
                                        const std::vector<const WorkPoint*>& candidates, std::size_t method) {
  std::optional<WorkPoint> best;
  for (const WorkPoint* point : candidates)
    if (point->method != method && (!best || is_better(question, *point, *best))) best = *point;
  return best;
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

bool keeps_within(const Question& question, const WorkPoint& point) {
  if (!point.finite) return false;
  return question.tolerance ? point.largest.position <= *question.tolerance
                            : point.run_time * question.period <= *question.budget;
}

bool allows_step(const Question& question, double h) { return h <= 1.001 * question.longest; }

bool divides_period(const Question& question, double h) {
  const double steps = question.period / h;
  return std::fabs(steps - std::round(steps)) < 1e-9 * steps;
}

std::optional<Advice> advise(const Question& asked, const WorkPrecision& study, const Flow<double>& flow,
                             double sampling, const ReferenceSolution& reference,
                             const std::vector<double>& held_inputs, const MotionFacts& facts) {
  Question question = asked;
  if (question.tolerance) *question.tolerance -= reference.position_error;
  const std::vector<const WorkPoint*> candidates =
      best_points(question, study.points, points_that_miss(question, study, flow, reference, facts), facts);
  if (candidates.empty()) return {};
  Advice advice;
  Trials trials(flow, sampling, reference, facts, question);
  if (question.tolerance) {
    std::tie(advice.method, advice.h) = cheapest(candidates, *question.tolerance, trials, reference);
  } else {
    const WorkPoint& best = **std::min_element(
        candidates.begin(), candidates.end(),
        [&](const WorkPoint* a, const WorkPoint* b) { return is_better(question, *a, *b); });
    advice.method = best.method;
    advice.h = best.h;
  }
  advice.runner_up = best_of_others(question, candidates, advice.method);
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
