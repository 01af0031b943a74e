#include "studies/advice.hpp"

#include <algorithm>
#include <cmath>

namespace jourdain::studies {

namespace {

/// Largest step below `longest` that keeps the tolerance: errors grow with h, so halve the range of step counts.
double longest_step(const WorkPoint& good, double tolerance, const Flow<double>& flow, double sampling,
                    const ReferenceSolution& reference) {
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

}  // namespace

std::optional<Advice> advise(const Question& question, const WorkPrecision& study, const Flow<double>& flow,
                             double sampling, const ReferenceSolution& reference,
                             const std::vector<double>& held_inputs) {
  const WorkPoint* best = nullptr;
  for (const WorkPoint& point : study.points) {
    if (!point.finite) continue;
    const double error = point.largest.position;
    if (question.tolerance && error > *question.tolerance) continue;
    if (question.budget &&
        (point.run_time * question.period > *question.budget || !is_whole(question.period / point.h)))
      continue;
    const bool better =
        !best || (question.tolerance ? point.run_time < best->run_time : error < best->largest.position);
    if (better) best = &point;
  }
  if (!best) return {};
  Advice advice;
  advice.method = best->method;
  advice.h =
      question.tolerance ? longest_step(*best, *question.tolerance, flow, sampling, reference) : best->h;
  const WorkPoint run = measure_errors(flow, advice.method, advice.h, sampling, reference, false);
  advice.error = run.largest;
  advice.step_time =
      measure_step_times(flow.table(), flow.start(), held_inputs, advice.h)[advice.method].median;
  advice.run_time = advice.step_time / advice.h;
  advice.confirmed = run.finite && (!question.tolerance || run.largest.position <= *question.tolerance) &&
                     (!question.budget || advice.run_time * question.period <= *question.budget);
  return advice;
}

}  // namespace jourdain::studies
