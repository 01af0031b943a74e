// Programs on intervals: what is proven of every point of a box at once.
#pragma once

#include <vector>

#include "ir/program.hpp"
#include "support/interval.hpp"

namespace jourdain::ir {

struct IntervalResults {
  std::vector<support::Interval> values;  ///< of the outputs, in order
  /// An output may have no value somewhere in the box: it needs a root of what may be negative, a quotient
  /// whose divisor may be zero, or the angle of what may be (0, 0). The enclosures hold where the values exist.
  std::vector<bool> maybe_undefined;
};

/// Encloses the outputs over all leaves within their intervals, in exact arithmetic: leaves vary independently
/// of each other, so that enclosures are wider than the ranges but shrink to them as the box does.
IntervalResults interpret_interval(const Program& program, const LeafValues<support::Interval>& leaves);

}  // namespace jourdain::ir
