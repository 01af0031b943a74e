// Solutions in double by CVODE of SUNDIALS.
#pragma once

#include <optional>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::studies {

/// Solution at start.t, start.t + interval, …, `count` intervals on, by CVODE's Adams methods with Newton iteration and
/// relative tolerance `tolerance` (absolute: a tenth of it). Where loops are open by more than that after an interval they are
/// closed, and CVODE starts anew. Nothing when CVODE gives up.
std::optional<std::vector<Point<double>>> solved_by_cvode(const Flow<double>& flow,
                                                          const Point<double>& start, double interval,
                                                          long count, double tolerance);

}  // namespace jourdain::studies
