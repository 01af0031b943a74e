// Tables of many points: the coefficients of the interval that an argument is in are entries of arrays.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "model/table_pieces.hpp"
#include "support/constant_array.hpp"

namespace jourdain::model {

namespace {

using support::Function;

/// Numbers and entries of arrays on top of a composition.
class Entries {
 public:
  explicit Entries(Composition& make) : make_(make) {}

  /// The place of an entry, of which a constant one is known.
  struct Number {
    std::size_t value = 0;
    std::optional<std::size_t> constant;
  };
  Number constant(std::size_t value) { return {make_.literal(static_cast<double>(value)), value}; }

  std::size_t entry(const std::vector<double>& values, const Number& place) {
    if (place.constant) return make_.literal(values[std::min(*place.constant, values.size() - 1)]);
    const bool are_equal =
        std::all_of(values.begin(), values.end(), [&](double v) { return v == values[0]; });
    if (are_equal) return make_.literal(values[0]);
    return make_.function(Function::kEntry, place.value, make_.literal(support::number_of_array(values)));
  }

 private:
  Composition& make_;
};

/// Equal distances but for rounding: then the interval follows from a quotient.
bool are_uniform(const std::vector<double>& points) {
  const double first = points.front(), last = points.back();
  const double width = (last - first) / static_cast<double>(points.size() - 1);
  const double rounding =
      4 * std::numeric_limits<double>::epsilon() * std::max(std::fabs(first), std::fabs(last));
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::fabs(points[i] - (first + static_cast<double>(i) * width)) > rounding) return false;
  return true;
}

/// Where an argument is among the intervals of an axis.
struct Place {
  Entries::Number number;  ///< of the interval, rounded down; beyond the ends it may be less or more
  std::size_t behind = 0;  ///< how far the argument is behind its beginning
};

/// Which interval it is follows from the argument as it is: held at an end it would stay between two of them.
Place place_of(Composition& make, std::size_t argument, const std::vector<double>& points, bool holds) {
  Entries entries(make);
  const std::vector<double> beginnings(points.begin(), points.end() - 1);
  Entries::Number number = entries.constant(0);
  if (beginnings.size() > 1 && are_uniform(points)) {
    const double width = (points.back() - points.front()) / static_cast<double>(beginnings.size());
    const std::size_t from_first = make.difference(argument, make.literal(points.front()));
    number = {make.quotient(from_first, make.literal(width)), {}};
  } else {
    for (std::size_t step = std::bit_floor(beginnings.size() - 1); step > 0; step /= 2) {
      const Entries::Number next =
          number.constant
              ? entries.constant(*number.constant + step)
              : Entries::Number{make.sum(number.value, make.literal(static_cast<double>(step))), {}};
      const std::size_t beyond = make.difference(argument, entries.entry(beginnings, next));
      const std::size_t taken =
          make.function(Function::kWhereNotNegative, beyond, make.literal(static_cast<double>(step)));
      number = {number.constant ? taken : make.sum(number.value, taken), {}};
    }
  }
  const std::size_t within = holds ? clamped(make, argument, points) : argument;
  return {number, make.difference(within, entries.entry(beginnings, number))};
}

/// Of polynomials in d the coefficients by their power, an array of each over the intervals.
template <std::size_t n>
std::size_t polynomial(Composition& make, std::size_t d, const std::array<std::size_t, n>& coefficients) {
  std::size_t value = coefficients[n - 1];
  for (std::size_t k = n - 1; k-- > 0;) value = make.sum(coefficients[k], make.product(d, value));
  return value;
}

Expression of_a_curve(const LookupTable& table, const Expression& argument) {
  const std::vector<double>& points = table.axes[0].points;
  const std::vector<double> values = constant_values(table);
  const bool is_linear = table.interpolation == Interpolation::kLinear;
  std::array<std::vector<double>, 4> arrays;
  const std::vector<double> slope = is_linear ? std::vector<double>() : slopes(table);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double width = points[i + 1] - points[i];
    const Cubic cubic = is_linear ? Cubic{values[i], (values[i + 1] - values[i]) / width, 0, 0}
                                  : cubic_of(values[i], slope[i], values[i + 1], slope[i + 1], width);
    for (std::size_t k = 0; k < cubic.size(); ++k) arrays[k].push_back(cubic[k]);
  }
  Composition make(std::span(&argument, 1));
  const Place place = place_of(make, 0, points, is_held(table));
  Entries entries(make);
  const auto coefficient = [&](std::size_t k) { return entries.entry(arrays[k], place.number); };
  const std::size_t value =
      is_linear ? polynomial<2>(make, place.behind, {coefficient(0), coefficient(1)})
                : polynomial<4>(make, place.behind,
                                {coefficient(0), coefficient(1), coefficient(2), coefficient(3)});
  if (goes_on_straight(table)) with_straight_ends(make, value, table);
  return make.finish();
}

using Grid = std::vector<std::vector<double>>;

Grid transposed(const Grid& grid) {
  Grid result(grid[0].size());
  for (const std::vector<double>& row : grid)
    for (std::size_t j = 0; j < row.size(); ++j) result[j].push_back(row[j]);
  return result;
}

Grid slopes_along_rows(const Grid& grid, const std::vector<double>& points) {
  Grid result;
  for (const std::vector<double>& row : grid) result.push_back(slopes(Interpolation::kSpline, points, row));
  return result;
}

/// Of the polynomial in a cell, those of d_x^a d_y^b.
using Bicubic = std::array<Cubic, 4>;

/// Of the natural spline in x of natural splines in y, cell by cell.
std::vector<Bicubic> bicubics(const Grid& f, const std::vector<double>& x, const std::vector<double>& y) {
  const Grid f_y = slopes_along_rows(f, y), f_x = transposed(slopes_along_rows(transposed(f), x)),
             f_xy = slopes_along_rows(f_x, y);
  std::vector<Bicubic> cells;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      const auto in_y = [&](const Grid& value, const Grid& slope, std::size_t row) {
        return cubic_of(value[row][j], slope[row][j], value[row][j + 1], slope[row][j + 1], y[j + 1] - y[j]);
      };
      const Cubic value = in_y(f, f_y, i), slope = in_y(f_x, f_xy, i), next_value = in_y(f, f_y, i + 1),
                  next_slope = in_y(f_x, f_xy, i + 1);
      Bicubic cell;
      for (std::size_t b = 0; b < 4; ++b) {
        const Cubic in_x = cubic_of(value[b], slope[b], next_value[b], next_slope[b], x[i + 1] - x[i]);
        for (std::size_t a = 0; a < 4; ++a) cell[a][b] = in_x[a];
      }
      cells.push_back(cell);
    }
  return cells;
}

/// The polynomials that are linear in x and in y, cell by cell; their other coefficients are 0.
std::vector<Bicubic> bilinears(const Grid& f, const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<Bicubic> cells;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      const double width = x[i + 1] - x[i], height = y[j + 1] - y[j];
      const double rise = (f[i][j + 1] - f[i][j]) / height, next = (f[i + 1][j + 1] - f[i + 1][j]) / height;
      Bicubic cell = {};
      cell[0] = {f[i][j], rise, 0, 0};
      cell[1] = {(f[i + 1][j] - f[i][j]) / width, (next - rise) / width, 0, 0};
      cells.push_back(cell);
    }
  return cells;
}

/// The number of a cell: that of its row times the cells of a row, and that of its column.
Entries::Number cell_of(Composition& make, const Place& in_x, std::size_t rows, const Place& in_y,
                        std::size_t columns) {
  std::vector<double> before_row, before_column;
  for (std::size_t i = 0; i < rows; ++i) before_row.push_back(static_cast<double>(i * columns));
  for (std::size_t j = 0; j < columns; ++j) before_column.push_back(static_cast<double>(j));
  Entries entries(make);
  return {make.sum(entries.entry(before_row, in_x.number), entries.entry(before_column, in_y.number)), {}};
}

template <std::size_t n>
Expression of_cells(const LookupTable& table, std::span<const Expression> arguments,
                    const std::vector<Bicubic>& cells) {
  const std::vector<double>&x = table.axes[0].points, &y = table.axes[1].points;
  Composition make(arguments);
  const bool holds = table.beyond == Beyond::kHold;
  const Place in_x = place_of(make, 0, x, holds), in_y = place_of(make, 1, y, holds);
  const Entries::Number cell = cell_of(make, in_x, x.size() - 1, in_y, y.size() - 1);
  Entries entries(make);
  std::array<std::size_t, n> rows;
  for (std::size_t a = 0; a < n; ++a) {
    std::array<std::size_t, n> row;
    for (std::size_t b = 0; b < n; ++b) {
      std::vector<double> values;
      for (const Bicubic& of_cell : cells) values.push_back(of_cell[a][b]);
      row[b] = entries.entry(values, cell);
    }
    rows[a] = polynomial<n>(make, in_y.behind, row);
  }
  polynomial<n>(make, in_x.behind, rows);
  return make.finish();
}

Expression of_a_grid(const LookupTable& table, std::span<const Expression> arguments) {
  const std::vector<double>&x = table.axes[0].points, &y = table.axes[1].points;
  const std::vector<double> values = constant_values(table);
  Grid f;
  for (std::size_t i = 0; i < x.size(); ++i)
    f.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(i * y.size()),
                   values.begin() + static_cast<std::ptrdiff_t>((i + 1) * y.size()));
  return table.interpolation == Interpolation::kLinear ? of_cells<2>(table, arguments, bilinears(f, x, y))
                                                       : of_cells<4>(table, arguments, bicubics(f, x, y));
}

}  // namespace

Expression by_entries(const LookupTable& table, std::span<const Expression> arguments) {
  return arguments.size() == 1 ? of_a_curve(table, arguments[0]) : of_a_grid(table, arguments);
}

}  // namespace jourdain::model
