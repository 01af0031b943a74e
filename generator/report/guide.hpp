// Where a method's errors follow its order.
#pragma once

#include "report/plot.hpp"

namespace jourdain::report {

/// A dashed line of slope −`order` (run time grows with 1/h) through a point of `series`, of error over run
/// time, both positive, run time rising: the last one that is well above `floor`, which is rounding's. It
/// covers the points before that one as long as they are near it; empty where none is.
Series order_guide(const Series& series, int order, double floor);

}  // namespace jourdain::report
