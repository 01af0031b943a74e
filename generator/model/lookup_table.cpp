#include "model/lookup_table.hpp"

#include <array>
#include <cmath>

#include "model/expression_sums.hpp"
#include "model/table_pieces.hpp"

namespace jourdain::model {

namespace {

using Points = std::span<const double>;
using support::Function;

/// f = c_0 + d (c_1 + d (c_2 + d c_3)) over each interval, d being how far x is behind its beginning.
using Piece = std::array<Expression, 4>;

std::vector<Piece> cubics(const LookupTable& table) {
  const std::vector<double>& points = table.axes[0].points;
  const std::vector<double> values = constant_values(table), slope = slopes(table);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const Cubic cubic = cubic_of(values[i], slope[i], values[i + 1], slope[i + 1], points[i + 1] - points[i]);
    pieces.push_back({cubic[0], cubic[1], cubic[2], cubic[3]});
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
    if (is_clamped) argument = clamped(make, argument, points);
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
  const bool is_linear = table.interpolation == Interpolation::kLinear;
  const std::vector<Piece> pieces = is_linear ? lines(points, table.values) : cubics(table);
  std::vector<Expression> list = {argument};
  for (const Piece& piece : pieces) list.insert(list.end(), piece.begin(), piece.end());
  Composition make(list);
  Place place(make, 0, points, is_held(table));
  std::size_t total = make.literal(0);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::size_t d = place.behind(i), c = 1 + 4 * i;
    const std::size_t bend = make.sum(c + 2, make.product(d, c + 3));
    const std::size_t slope = make.sum(c + 1, make.product(d, bend));
    total = make.sum(total, place.chosen(i, make.sum(c, make.product(d, slope))));
  }
  if (goes_on_straight(table)) with_straight_ends(make, total, table);
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

std::vector<double> constant_values(const LookupTable& table) {
  std::vector<double> values;
  for (const Expression& value : table.values) values.push_back(value.constant());
  return values;
}

std::size_t clamped(Composition& make, std::size_t argument, Points points) {
  const std::size_t above = make.function(Function::kMax, argument, make.literal(points.front()));
  return make.function(Function::kMin, above, make.literal(points.back()));
}

std::size_t with_straight_ends(Composition& make, std::size_t held, const LookupTable& table) {
  const Points points = table.axes[0].points;
  const std::vector<double> slope = slopes(table);
  const auto beyond = [&](Function side, double point, double by) {
    const std::size_t distance = make.difference(0, make.literal(point));
    // At the point itself the slope is that of 0: `held` has its own there, as min and max take their first argument's.
    return make.product(make.literal(by), make.function(side, make.literal(0), distance));
  };
  held = make.sum(held, beyond(Function::kMin, points.front(), slope.front()));
  return make.sum(held, beyond(Function::kMax, points.back(), slope.back()));
}

bool has_entries(const LookupTable& table) {
  constexpr std::size_t kFewIntervals = 3, kFewCells = 4;
  if (!std::all_of(table.values.begin(), table.values.end(),
                   [](const Expression& v) { return v.is_constant(); }))
    return false;
  if (table.axes.size() == 1) return table.axes[0].points.size() - 1 > kFewIntervals;
  const std::size_t cells = (table.axes[0].points.size() - 1) * (table.axes[1].points.size() - 1);
  return table.interpolation != Interpolation::kLinear || cells > kFewCells;
}

bool goes_on_straight(const LookupTable& table) {
  return table.beyond == Beyond::kExtend && table.interpolation != Interpolation::kLinear;
}

bool is_held(const LookupTable& table) { return table.beyond == Beyond::kHold || goes_on_straight(table); }

std::vector<double> slopes(const LookupTable& table) {
  return slopes(table.interpolation, table.axes[0].points, constant_values(table),
                table.beyond == Beyond::kRepeat);
}

namespace {

/// `argument` less the number of periods that it is behind the first point.
Expression within_period(const Expression& argument, Points points) {
  const Expression period = points.back() - points.front();
  const Expression periods =
      Expression::binary(Expression::Op::kDivide, minus(argument, points.front()), period);
  return minus(argument, times(period, Expression::function(Function::kFloor, periods)));
}

}  // namespace

Expression looked_up(const LookupTable& table, std::span<const Expression> arguments) {
  JD_CHECK(arguments.size() == table.axes.size(), "table '{}' has {} axes", table.name, table.axes.size());
  const bool repeats = table.beyond == Beyond::kRepeat;
  JD_CHECK(!repeats || table.axes.size() == 1, "table '{}' repeats and has two axes", table.name);
  const std::vector<Expression> within = repeats
                                             ? std::vector{within_period(arguments[0], table.axes[0].points)}
                                             : std::vector(arguments.begin(), arguments.end());
  if (has_entries(table)) return by_entries(table, within);
  return within.size() == 1 ? on_a_curve(table, within[0]) : on_a_grid(table, within);
}

Callable callable(LookupTable table) {
  Callable result{"table", table.name, {{"x", table.axes[0].measure}}, table.measure, {}, table.where};
  if (table.axes.size() == 2) result.arguments.push_back({"y", table.axes[1].measure});
  if (table.interpolation == Interpolation::kSpline)
    result.smooth =
        table.beyond == Beyond::kHold ? Callable::Smooth::kWithinEnds : Callable::Smooth::kEverywhere;
  result.value = [table = std::move(table)](std::span<const Expression> arguments) {
    return looked_up(table, arguments);
  };
  return result;
}

}  // namespace jourdain::model
