// Solutions in double by CVODE of SUNDIALS.
#pragma once

#include <optional>
#include <vector>

#include "studies/adaptive_integrator.hpp"
#include "studies/flow.hpp"

namespace jourdain::studies {

/// Solution at start.t, start.t + interval, …, `count` intervals on, by CVODE's Adams methods with Newton iteration and
/// relative tolerance `tolerance` (absolute: a tenth of it). Where loops are open by more than that after an
/// interval they are closed, and CVODE starts anew. Nothing when CVODE gives up.
std::optional<std::vector<Point<double>>> solved_by_cvode(const Flow<double>& flow,
                                                          const Point<double>& start, double interval,
                                                          long count, double tolerance);

/// As one calls CVODE: Adams methods with fixed-point iteration, or BDF with Newton iteration and dense
/// Jacobians by differences.
enum class CvodeKind { kAdams, kBdf };

/// Relative tolerance `tolerance`, absolute a tenth of it. `rates` must outlive the result.
std::unique_ptr<AdaptiveIntegrator> make_cvode(CvodeKind kind, CountedRates& rates,
                                               const Point<double>& start, double end, double tolerance);

}  // namespace jourdain::studies
