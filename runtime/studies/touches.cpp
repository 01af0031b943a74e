#include "studies/touches.hpp"

#include <algorithm>
#include <cmath>

namespace jourdain::studies {

namespace {

constexpr double kMostSteps = 4e6;
constexpr double kReserve = 0.2;  ///< of the wanted depth: dampers stay as they are where stiffness grows

/// The most accurate run that does not take too long.
const WorkPoint* best_run(const WorkPrecision& work, double duration) {
  const WorkPoint* best = nullptr;
  for (const WorkPoint& point : work.points)
    if (point.finite && duration / point.h <= kMostSteps &&
        (!best || point.largest.position < best->largest.position))
      best = &point;
  return best;
}

}  // namespace

std::optional<Touches> study_touches(const Flow<double>& flow, const std::vector<TouchFacts>& elements,
                                     const WorkPrecision& work, double duration) {
  const WorkPoint* best = elements.empty() ? nullptr : best_run(work, duration);
  if (!best) return {};
  Touches touches{best->method, best->h, best->largest, std::vector<TouchRun>(elements.size())};
  const jourdain_model_table& table = flow.table();
  const jourdain_method& method = table.methods[best->method];
  std::vector<double> values(static_cast<std::size_t>(table.output_count));
  Point<double> point = flow.start();
  Memory memory = flow.fresh_memory(method);
  const long steps = std::lround(duration / best->h);
  for (long n = 0; n <= steps; ++n) {
    const std::vector<double> u = flow.inputs().at(point.t);
    table.outputs(&point.t, point.x.data(), point.x.data() + table.position_count, u.data(), values.data());
    for (std::size_t i = 0; i < elements.size(); ++i) {
      TouchRun& run = touches.runs[i];
      const double depth = values[values.size() - elements.size() + i];
      if (n == 0) run.start = std::max(depth, 0.0);
      if (depth > 0) run.share += 1 / static_cast<double>(steps + 1);
      if (depth > run.deepest) {
        run.deepest = depth;
        run.at = point.t;
      }
    }
    if (n < steps) flow.step(method, point, best->h, 1, memory);
  }
  return touches;
}

Stiffening stiffening(const TouchFacts& element, double deepest, double wanted) {
  const double ratio = deepest / ((1 - kReserve) * wanted);
  return {element.stiffness * std::pow(ratio, element.exponent + 1), 1 / ratio};
}

}  // namespace jourdain::studies
