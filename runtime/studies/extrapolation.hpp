// Solutions in 50 digits by extrapolation.
#pragma once

#include <optional>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::studies {

struct ExtrapolationOptions {
  double tolerance = 1e-26;         ///< of a step, relative to 1 + |x|
  long evaluation_limit = 1000000;  ///< of f, for the whole solution
};

/// Solution at start.t, start.t + interval, …, `count` intervals on, by the method of Gragg, Bulirsch and
/// Stoer (modified midpoint rule with 2, 4, 6, … substeps, polynomial extrapolation in the squares of their
/// lengths; Hairer, Nørsett, Wanner, Solving ODEs I, II.9). A step in which twelve columns do not reach the
/// tolerance is halved. The rates move all positions, those that depend on others too; loops are closed again
/// after each interval. Nothing when the limit is passed, or will be as it goes.
std::optional<std::vector<Point<LongReal>>> extrapolated(const Flow<LongReal>& flow,
                                                         const Point<LongReal>& start, double interval,
                                                         long count, const ExtrapolationOptions& options);

}  // namespace jourdain::studies
