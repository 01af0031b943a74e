// Functions of one or two arguments that are given by points, as expressions call them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "model/callable.hpp"
#include "model/expression.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

enum class Interpolation {
  kLinear,
  kMonotone,  ///< cubics with the same slope on both sides of a point, without overshoot
  kSpline     ///< cubics with the same slope and curvature; curvature 0 at ends that do not repeat
};
enum class Beyond {
  kHold,    ///< the value at the end
  kExtend,  ///< a straight line with the slope at the end
  kRepeat   ///< the same again and again: one argument, the values at both ends are equal numbers
};

/// Of a table whose values are not constant.
inline constexpr std::size_t kMaximumTableValues = 400;
/// Coefficients of all intervals or cells, and places of points.
inline constexpr std::size_t kMaximumTableNumbers = 20000;

/// Values at points of an axis, or on the grid of two. Points rise, two or more an axis.
struct LookupTable {
  struct Axis {
    std::vector<double> points;
    Measure measure = Measure::open();
  };
  std::string name;
  std::vector<Axis> axes;          ///< x, or x and y
  std::vector<Expression> values;  ///< those of the first x first
  Measure measure = Measure::open();
  Interpolation interpolation = Interpolation::kLinear;  ///< cubics: values are constant; of two axes splines
  Beyond beyond = Beyond::kHold;
  support::SourceRange where;
};

/// Are its coefficients entries of arrays? Of few intervals, or where values are not constant, all are computed.
bool has_entries(const LookupTable& table);

/// The table's value, of as many arguments as it has axes, without a branch and at one cost everywhere. It has its
/// values at its points, and there the slopes of the intervals above.
///   has_entries   the polynomial of the interval that the argument is in: where points have equal distances by a
///                 quotient, at a cost that does not depend on their number (at a point rounding may choose the
///                 interval below), else by as many comparisons as their number has binary digits
///   otherwise     pieces of which one is taken: 4 operations and 2 selections an interval, of cubics 8 and 2; on a
///                 grid values by their weights, 2 operations a value, 4 and 4 selections an interval
Expression looked_up(const LookupTable& table, std::span<const Expression> arguments);

/// Slopes at the points of a curve through `values`, of these kinds:
///   kMonotone  Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304, weighted for unequal intervals as in
///              SLATEC's PCHIM; where neighbours rise and fall 0
///   kSpline    natural or, where the curve repeats, periodic cubic spline; de Boor, A Practical Guide to Splines
///              (1978), chapter IV
std::vector<double> slopes(Interpolation kind, std::span<const double> points, std::span<const double> values,
                           bool repeats = false);
/// Those of a curve of cubics.
std::vector<double> slopes(const LookupTable& table);

/// What expressions call it by.
Callable callable(LookupTable table);

}  // namespace jourdain::model
