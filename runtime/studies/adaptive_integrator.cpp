#include "studies/adaptive_integrator.hpp"

#include <algorithm>
#include <cmath>

namespace jourdain::studies {

namespace {

/// Steps until `t` is reached.
bool reach(AdaptiveIntegrator& integrator, const CountedRates& rates, double t, long call_limit,
           AdaptiveRun& run) {
  while (integrator.time() < t) {
    const long before = run.calls;
    const bool done = integrator.step();
    run.calls = rates.calls();
    if (!done || run.calls > call_limit) return false;
    ++run.steps;
    run.worst_calls = std::max(run.worst_calls, run.calls - before);
  }
  return true;
}

}  // namespace

AdaptiveRun follow(AdaptiveIntegrator& integrator, const CountedRates& rates,
                   const std::vector<double>& times, double tolerance, long call_limit) {
  const Flow<double>& flow = rates.flow();
  AdaptiveRun run;
  run.points.reserve(times.size());
  for (const double t : times) {
    if (!reach(integrator, rates, t, call_limit, run)) return run;
    Point<double>& point = run.points.emplace_back(Point<double>{t, std::vector<double>(flow.size())});
    integrator.interpolate(t, point.x.data());
    if (!flow.has_loops()) continue;
    const Residuals open = flow.residuals_of_closed_rows(point);
    if (std::max(open.position, open.velocity) <= tolerance) continue;
    point = flow.closed(point);
    integrator.restart(point);
  }
  run.finished = true;
  return run;
}

}  // namespace jourdain::studies
