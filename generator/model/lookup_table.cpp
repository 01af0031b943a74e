#include "model/lookup_table.hpp"

#include <array>
#include <cmath>

#include "model/composition.hpp"
#include "model/expression_sums.hpp"

namespace jourdain::model {

namespace {

using Points = std::span<const double>;
using support::Function;

/// Intervals and the slopes of the chords over them.
struct Chords {
  std::vector<double> widths, slopes;
};

Chords chords_of(Points points, Points values) {
  Chords chords;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    chords.widths.push_back(points[i + 1] - points[i]);
    chords.slopes.push_back((values[i + 1] - values[i]) / chords.widths[i]);
  }
  return chords;
}

bool have_one_sign(double a, double b) { return (a > 0 && b > 0) || (a < 0 && b < 0); }

/// Of the parabola through three points, at the first, but without overshoot.
double end_slope(double width, double next_width, double slope, double next_slope) {
  const double parabola = ((2 * width + next_width) * slope - width * next_slope) / (width + next_width);
  if (!have_one_sign(parabola, slope)) return 0;
  const bool turns = !have_one_sign(slope, next_slope);
  return turns && std::fabs(parabola) > 3 * std::fabs(slope) ? 3 * slope : parabola;
}

std::vector<double> monotone_slopes(const Chords& chords) {
  const auto& [h, s] = chords;
  const std::size_t last = h.size();
  std::vector<double> slopes(last + 1);
  for (std::size_t i = 1; i < last; ++i) {
    if (!have_one_sign(s[i - 1], s[i])) continue;
    const double before = h[i - 1] + 2 * h[i], after = 2 * h[i - 1] + h[i];
    slopes[i] = (before + after) / (before / s[i - 1] + after / s[i]);
  }
  slopes[0] = end_slope(h[0], h[1], s[0], s[1]);
  slopes[last] = end_slope(h[last - 1], h[last - 2], s[last - 1], s[last - 2]);
  return slopes;
}

/// Of the tridiagonal system by elimination; each row's diagonal is the sum of its neighbours at least.
std::vector<double> spline_slopes(const Chords& chords) {
  const auto& [h, s] = chords;
  const std::size_t last = h.size();
  std::vector<double> diagonal(last + 1), right(last + 1), upper(last + 1);
  for (std::size_t i = 0; i <= last; ++i) {
    const bool first = i == 0, end = i == last;
    const double lower = first ? 0 : end ? 1 : h[i];
    upper[i] = first ? 1 : end ? 0 : h[i - 1];
    diagonal[i] = 2 * (lower + upper[i]);
    right[i] = first ? 3 * s[0] : end ? 3 * s[last - 1] : 3 * (h[i] * s[i - 1] + h[i - 1] * s[i]);
    if (first) continue;
    const double factor = lower / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    right[i] -= factor * right[i - 1];
  }
  std::vector<double> slopes(last + 1);
  for (std::size_t i = last + 1; i-- > 0;)
    slopes[i] = (right[i] - (i == last ? 0 : upper[i] * slopes[i + 1])) / diagonal[i];
  return slopes;
}

/// f = c_0 + d (c_1 + d (c_2 + d c_3)) over each interval, d being how far x is behind its beginning.
using Piece = std::array<Expression, 4>;

/// By Hermite's formula.
std::vector<Piece> cubics(Interpolation kind, Points points, const std::vector<Expression>& given) {
  std::vector<double> values;
  for (const Expression& value : given) values.push_back(value.constant());
  const std::vector<double> slope = slopes(kind, points, values);
  const Chords chords = chords_of(points, values);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double h = chords.widths[i], bend = (slope[i] - 2 * chords.slopes[i] + slope[i + 1]) / h;
    pieces.push_back({values[i], slope[i], (chords.slopes[i] - slope[i]) / h - bend, bend / h});
  }
  return pieces;
}

std::vector<Piece> lines(Points points, const std::vector<Expression>& values) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const Expression slope = Expression::binary(Expression::Op::kDivide, minus(values[i + 1], values[i]),
                                                points[i + 1] - points[i]);
    pieces.push_back({values[i], slope, 0.0, 0.0});
  }
  return pieces;
}

/// Where an argument stands among the points of an axis.
class Place {
 public:
  Place(Composition& make, std::size_t argument, Points points, bool is_clamped)
      : make_(make), points_(points) {
    if (is_clamped) {
      const std::size_t above = make.function(Function::kMax, argument, make.literal(points.front()));
      argument = make.function(Function::kMin, above, make.literal(points.back()));
    }
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      behind_.push_back(make.difference(argument, make.literal(points[i])));
  }

  std::size_t intervals() const { return behind_.size(); }
  /// How far the argument is behind the beginning of an interval.
  std::size_t behind(std::size_t interval) const { return behind_[interval]; }

  /// `value` where the argument is in the interval, of which the first and the last have no end outside; otherwise 0.
  std::size_t chosen(std::size_t interval, std::size_t value) {
    if (interval > 0) value = make_.function(Function::kWhereNotNegative, behind_[interval], value);
    if (interval + 1 < intervals())
      value = make_.function(Function::kWhereNegative, behind_[interval + 1], value);
    return value;
  }

  /// Weights of the points, of which two next to each other are not zero; their sum is 1.
  std::vector<std::size_t> weights() {
    std::vector<std::size_t> weights(points_.size(), make_.literal(0));
    for (std::size_t i = 0; i < intervals(); ++i) {
      const double width = points_[i + 1] - points_[i];
      const std::size_t share = chosen(i, make_.quotient(behind_[i], make_.literal(width)));
      weights[i] = make_.sum(weights[i], make_.difference(chosen(i, make_.literal(1)), share));
      weights[i + 1] = share;
    }
    return weights;
  }

 private:
  Composition& make_;
  Points points_;
  std::vector<std::size_t> behind_;
};

Expression on_a_curve(const LookupTable& table, const Expression& argument) {
  const Points points = table.axes[0].points;
  const bool is_linear = table.interpolation == Interpolation::kLinear, holds = table.beyond == Beyond::kHold;
  const std::vector<Piece> pieces =
      is_linear ? lines(points, table.values) : cubics(table.interpolation, points, table.values);
  std::vector<Expression> list = {argument};
  for (const Piece& piece : pieces) list.insert(list.end(), piece.begin(), piece.end());
  Composition make(list);
  Place place(make, 0, points, holds || !is_linear);
  std::size_t total = make.literal(0);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::size_t d = place.behind(i), c = 1 + 4 * i;
    const std::size_t bend = make.sum(c + 2, make.product(d, c + 3));
    const std::size_t slope = make.sum(c + 1, make.product(d, bend));
    total = make.sum(total, place.chosen(i, make.sum(c, make.product(d, slope))));
  }
  if (holds || is_linear) return make.finish();
  std::vector<double> values;
  for (const Expression& value : table.values) values.push_back(value.constant());
  const std::vector<double> slope = slopes(table.interpolation, points, values);
  const auto beyond = [&](Function side, double point, double by) {
    const std::size_t distance = make.difference(0, make.literal(point));
    return make.product(make.literal(by), make.function(side, distance, make.literal(0)));
  };
  total = make.sum(total, beyond(Function::kMin, points.front(), slope.front()));
  make.sum(total, beyond(Function::kMax, points.back(), slope.back()));
  return make.finish();
}

Expression on_a_grid(const LookupTable& table, std::span<const Expression> arguments) {
  std::vector<Expression> list(arguments.begin(), arguments.end());
  list.insert(list.end(), table.values.begin(), table.values.end());
  Composition make(list);
  const bool holds = table.beyond == Beyond::kHold;
  const std::vector<std::size_t> of_x = Place(make, 0, table.axes[0].points, holds).weights(),
                                 of_y = Place(make, 1, table.axes[1].points, holds).weights();
  std::size_t total = make.literal(0), value = arguments.size();
  for (const std::size_t wx : of_x) {
    std::size_t row = make.literal(0);
    for (const std::size_t wy : of_y) row = make.sum(row, make.product(wy, value++));
    total = make.sum(total, make.product(wx, row));
  }
  return make.finish();
}

}  // namespace

std::vector<double> slopes(Interpolation kind, Points points, Points values) {
  const Chords chords = chords_of(points, values);
  if (points.size() == 2) return {chords.slopes[0], chords.slopes[0]};
  JD_CHECK(kind != Interpolation::kLinear, "straight lines have two slopes at a point");
  return kind == Interpolation::kMonotone ? monotone_slopes(chords) : spline_slopes(chords);
}

Expression looked_up(const LookupTable& table, std::span<const Expression> arguments) {
  JD_CHECK(arguments.size() == table.axes.size(), "table '{}' has {} axes", table.name, table.axes.size());
  return arguments.size() == 1 ? on_a_curve(table, arguments[0]) : on_a_grid(table, arguments);
}

}  // namespace jourdain::model
