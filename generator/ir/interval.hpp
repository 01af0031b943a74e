// Programs on intervals: what is proven of every point of a box at once.
#pragma once

#include <limits>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::ir {

/// All real numbers from `low` to `high`; the ends may be infinite.
struct Interval {
  double low = 0, high = 0;

  /// One number.
  static Interval point(double value) { return {value, value}; }
  static constexpr Interval line() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  bool contains(double value) const { return low <= value && value <= high; }
  double width() const { return high - low; }
  double middle() const { return low + width() / 2; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// Enclosures of a − b, a · b and so on, rounded outward: of any reals in the operands the exact result is inside.
Interval operator+(Interval a, Interval b);
Interval operator-(Interval a, Interval b);
Interval operator*(Interval a, Interval b);

struct IntervalResults {
  std::vector<Interval> values;  ///< of the outputs, in order
  /// An output may have no value somewhere in the box: it needs a root of what may be negative, a quotient
  /// whose divisor may be zero, or the angle of what may be (0, 0). The enclosures hold where the values exist.
  std::vector<bool> maybe_undefined;
};

/// Encloses the outputs over all leaves within their intervals, in exact arithmetic: leaves vary independently
/// of each other, so that enclosures are wider than the ranges but shrink to them as the box does. Sines and
/// cosines of the C library are taken to be within 4 units of the last place.
IntervalResults interpret_interval(const Program& program, const LeafValues<Interval>& leaves);

}  // namespace jourdain::ir
