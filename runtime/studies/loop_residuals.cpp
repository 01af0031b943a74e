#include "studies/loop_residuals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace jourdain::studies {

namespace {

constexpr double kAccurate = 1e-6;  ///< rad, m
constexpr double kLonger = 10;

/// Null where every run failed.
const WorkPoint* usual_point(const WorkPrecision& work) {
  const WorkPoint* best = nullptr;
  for (const WorkPoint& point : work.points) {
    if (!point.finite) continue;
    const bool within = point.largest.position <= kAccurate;
    const bool best_within = best && best->largest.position <= kAccurate;
    const bool better = !best || (within && !best_within) ||
                        (within == best_within && (within ? point.run_time < best->run_time
                                                          : point.largest.position < best->largest.position));
    if (better) best = &point;
  }
  return best;
}

LoopRun run(const Flow<double>& flow, std::size_t method, double h, double duration) {
  LoopRun result{method, h, std::max(1L, std::lround(duration / h)), {}, true};
  Point<double> point = flow.start();
  const jourdain_method& stepper = flow.table().methods[method];
  Memory memory = flow.fresh_memory(stepper);
  for (long k = 0; k < result.steps && result.finite; ++k) {
    flow.step(stepper, point, h, 1, memory);
    const Residuals open = flow.residuals(point);
    result.finite = std::isfinite(open.position) && std::isfinite(open.velocity);
    result.finite = result.finite && flow.is_trusted();
    if (!result.finite) break;
    result.open.position = std::max(result.open.position, open.position);
    result.open.velocity = std::max(result.open.velocity, open.velocity);
  }
  return result;
}

}  // namespace

std::optional<Untrusted> first_untrusted(const Flow<double>& flow, double h, double duration,
                                         double most_open) {
  if (!flow.has_loops()) return {};
  Point<double> point = flow.start();
  const jourdain_method& stepper = flow.table().methods[0];
  Memory memory = flow.fresh_memory(stepper);
  for (long k = 1; k * h <= duration; ++k) {
    flow.step(stepper, point, h, 1, memory);
    const double now = static_cast<double>(k) * h;
    if (!flow.is_trusted())
      return Untrusted{
          now, "the loops' closing turns singular, or a coordinate leaves the range for which it is proven"};
    if (!std::isfinite(most_open)) continue;
    if (const double open = flow.residuals(point).position; open > most_open)
      return Untrusted{
          now, fmt::format("constraints contradict each other, those that follow from the others are open by "
                           "{:.2g} m",
                           open)};
  }
  return {};
}

std::vector<LoopRun> study_loops(const Flow<double>& flow, const WorkPrecision& work, const Advice* advice,
                                 double duration) {
  const WorkPoint* usual = usual_point(work);
  if (!flow.has_loops() || (!advice && !usual)) return {};
  const std::size_t method = advice ? advice->method : usual->method;
  const double h = advice ? advice->h : usual->h;
  return {run(flow, method, h, duration), run(flow, method, kLonger * h, duration)};
}

}  // namespace jourdain::studies
