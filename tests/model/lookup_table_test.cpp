// Functions given by points against independent interpolation, and how files give them.
#include "model/lookup_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <span>

#include "model/read/read.hpp"
#include "model/taylor.hpp"
#include "properties/random.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::model {
namespace {

using tests::Random;

LookupTable curve(const std::vector<double>& x, const std::vector<double>& y, Interpolation kind,
                  Beyond beyond = Beyond::kHold) {
  LookupTable table{
      .name = "f", .axes = {{x}}, .values = {}, .interpolation = kind, .beyond = beyond, .where = {}};
  for (const double value : y) table.values.emplace_back(value);
  return table;
}

const Variable kX = {Variable::Kind::kTime}, kY = {Variable::Kind::kInput};

const std::array<Expression, 2> kArguments = {Expression::variable(kX), Expression::variable(kY)};

/// A table and its value, of kX and kY.
struct Function {
  Function(const LookupTable& table)  // NOLINT: a table is one
      : value(looked_up(table, std::span(kArguments).first(table.axes.size()))) {}
  Expression value;
};

double at(const Function& function, double x, double y = 0, const std::vector<double>& parameters = {}) {
  return function.value.evaluate<double>(
      parameters, [](double v) { return v; }, [&](const Variable& v) { return v == kX ? x : y; });
}

// RPN 14 of Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238-246: it rises in steps.
const std::vector<double> kPoints = {7.99, 8.09, 8.19, 8.7, 9.2, 10, 12, 15, 20};
const std::vector<double> kValues = {0,       2.76429e-5, 4.37498e-2, 0.169183, 0.469428,
                                     0.94374, 0.998636,   0.999919,   0.999994};

TEST(LookupTable, IsMonotoneWithTheSlopesOfSlatec) {
  // Of SciPy 1.10.1, interpolate.PchipInterpolator.
  const std::vector<double> x = {8.0, 8.05, 8.3, 8.9, 9.5, 11, 13.5, 19};
  const std::vector<double> expected = {2.767433863187248e-07, 9.956474181099992e-06, 0.07496322315646736,
                                        0.2713755846049045,    0.6852179451108994,    0.9860433625350502,
                                        0.999603364012177,     0.9999912279493809};
  const Function table = curve(kPoints, kValues, Interpolation::kMonotone);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(at(table, x[i]), expected[i], 3e-15) << x[i];
  const std::vector<double> slope = slopes(Interpolation::kMonotone, kPoints, kValues);
  EXPECT_EQ(slope[0], 0);
  EXPECT_NEAR(slope[3], 0.3494491676859672, 1e-14);
  EXPECT_NEAR(slope[7], 3.142468363044495e-05, 1e-18);
  EXPECT_THAT(
      slopes(Interpolation::kMonotone, std::vector<double>{0, 0.5, 2, 3},
             std::vector<double>{1, -1, 0.5, 0.25}),
      testing::ElementsAre(testing::DoubleNear(-5.25, 1e-15), 0, 0, testing::DoubleNear(-0.75, 1e-15)));
}

TEST(LookupTable, HasSlopesOfAnySize) {
  std::vector<double> small = kValues;
  for (double& value : small) value *= 0x1p-600;
  const std::vector<double> slope = slopes(Interpolation::kMonotone, kPoints, kValues),
                            scaled = slopes(Interpolation::kMonotone, kPoints, small);
  for (std::size_t i = 0; i < slope.size(); ++i) EXPECT_EQ(scaled[i], slope[i] * 0x1p-600);
}

TEST(LookupTable, IsANaturalSpline) {
  // Of SciPy 1.10.1, interpolate.CubicSpline(bc_type='natural').
  const std::vector<double> x = {8.0, 8.05, 8.3, 8.9, 9.5, 11, 13.5, 19};
  const std::vector<double> expected = {-0.0011698987791842791, -0.004531925558654245, 0.08506353487676065,
                                        0.2649158515053023,     0.6745854438434359,    1.0990000605398995,
                                        0.9464663683480324,     1.0174642534652611};
  const Function table = curve(kPoints, kValues, Interpolation::kSpline);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(at(table, x[i]), expected[i], 1e-14) << x[i];
  const std::vector<double> slope = slopes(Interpolation::kSpline, std::vector<double>{0, 0.5, 2, 3},
                                           std::vector<double>{1, -1, 0.5, 0.25});
  const std::vector<double> slopes_expected = {-4.757042253521127, -2.4859154929577465, 1.1584507042253522,
                                               -0.954225352112676};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(slope[i], slopes_expected[i], 1e-15);
}

TEST(LookupTable, IsAPeriodicSpline) {
  // By hand: 4 m0 + m1 + m2 = 6, 2 m0 + 6 m1 + m2 = 3, 2 m0 + m1 + 6 m2 = 3.
  const std::vector<double> x = {0, 1, 3, 4}, y = {0, 1, -1, 0},
                            slope = slopes(Interpolation::kSpline, x, y, true);
  const std::vector<double> expected = {1.5, 0, 0, 1.5};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(slope[i], expected[i], 1e-15);
  const std::vector<double> twice =
      slopes(Interpolation::kSpline, std::vector<double>{0, 1, 3}, std::vector<double>{2, 5, 2}, true);
  for (const double m : twice) EXPECT_NEAR(m, 1.5, 1e-15);  // 6 m0 + 3 m1 = 13.5, 3 m0 + 6 m1 = 13.5
}

std::vector<double> rising(Random& random, std::size_t count, double step) {
  std::vector<double> numbers = {random.uniform(-2, 2)};
  while (numbers.size() < count) numbers.push_back(numbers.back() + random.uniform(0, step) + 1e-3);
  return numbers;
}

TEST(LookupTable, OfMonotoneValuesIsMonotoneAndOfOthersBetweenNeighbours) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const std::size_t n = 2 + random.below(12);
    const std::vector<double> x = rising(random, n, 3);
    std::vector<double> y = rising(random, n, random.chance(0.5) ? 0.0 : 5.0);
    const bool is_monotone = random.chance(0.5);
    if (!is_monotone)
      for (double& value : y) value = random.uniform(-1, 1);
    const Function table = curve(x, y, Interpolation::kMonotone);
    double last = at(table, x[0] - 1);
    for (std::size_t k = 0; k + 1 < n; ++k)
      for (int step = 0; step <= 20; ++step) {
        const double value = at(table, x[k] + (x[k + 1] - x[k]) * step / 20);
        EXPECT_GE(value, std::min(y[k], y[k + 1]) - 1e-13);
        EXPECT_LE(value, std::max(y[k], y[k + 1]) + 1e-13);
        if (is_monotone) {
          EXPECT_GE(value, last - 1e-13);
        }
        last = value;
      }
  }
}

TEST(LookupTable, RepeatsWithTheSlopesOfTheOtherEndAtItsSeam) {
  Random random(5);
  for (const auto kind : {Interpolation::kLinear, Interpolation::kMonotone, Interpolation::kSpline})
    for (int i = 0; i < 50; ++i) {
      const std::size_t n = 2 + random.below(30);
      const std::vector<double> x = rising(random, n, 2);
      const double period = x.back() - x.front();
      std::vector<double> y;
      for (std::size_t k = 0; k < n; ++k) y.push_back(random.uniform(-3, 3));
      y.back() = y.front();
      const Function table = curve(x, y, kind, Beyond::kRepeat);
      for (std::size_t k = 0; k < n; ++k)
        for (const double periods : {-7.0, 0.0, 3.0})
          EXPECT_NEAR(at(table, x[k] + periods * period), y[k], 1e-9);
      if (kind == Interpolation::kLinear || n == 2) continue;
      // Many periods as one curve: from interval to interval what its ends are reaches half as far at most.
      constexpr int kIntervals = 60;
      const int most = 1 + kIntervals / int(n - 1);
      std::vector<double> points, values;
      for (int p = -most; p <= most; ++p)
        for (std::size_t k = p == -most ? 0 : 1; k < n; ++k) {
          points.push_back(x[k] + p * period);
          values.push_back(y[k]);
        }
      const Function many = curve(points, values, kind);
      for (int step = 0; step <= 40; ++step) {
        const double place = x.front() + period * step / 40;
        EXPECT_NEAR(at(table, place), at(many, place), 1e-10) << n;
      }
    }
}

TEST(LookupTable, HasItsValuesAtItsPointsAndHoldsOrExtendsThemBeyond) {
  Random random(4);
  for (const auto kind : {Interpolation::kLinear, Interpolation::kMonotone, Interpolation::kSpline})
    for (int i = 0; i < 50; ++i) {
      const std::size_t n = 2 + random.below(30);
      const std::vector<double> x = rising(random, n, 2);
      std::vector<double> y;
      for (std::size_t k = 0; k < n; ++k) y.push_back(random.uniform(-3, 3));
      const Function held = curve(x, y, kind), extended = curve(x, y, kind, Beyond::kExtend);
      for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(at(held, x[k]), y[k], k + 1 < n ? 0 : 2e-14);
      for (const double far : {0.5, 1e3, 1e300}) {
        EXPECT_EQ(at(held, x[0] - far), y[0]);
        EXPECT_NEAR(at(held, x[n - 1] + far), y[n - 1], 2e-14);
      }
      const double before =
          kind == Interpolation::kLinear ? (y[1] - y[0]) / (x[1] - x[0]) : slopes(kind, x, y).front();
      const double behind = kind == Interpolation::kLinear ? (y[n - 1] - y[n - 2]) / (x[n - 1] - x[n - 2])
                                                           : slopes(kind, x, y).back();
      EXPECT_NEAR(at(extended, x[0] - 2), y[0] - 2 * before, 1e-11);
      EXPECT_NEAR(at(extended, x[n - 1] + 2), y[n - 1] + 2 * behind, 1e-11);
    }
}

TEST(LookupTable, HasOneSlopeWhereItGoesOnStraight) {
  Random random(8);
  for (const auto kind : {Interpolation::kMonotone, Interpolation::kSpline})
    for (const std::size_t n : {2, 3, 4, 5, 20}) {
      const std::vector<double> x = rising(random, n, 2);
      std::vector<double> y;
      for (std::size_t k = 0; k < n; ++k) y.push_back(k * k + random.uniform(-0.2, 0.2));
      const Function extended = curve(x, y, kind, Beyond::kExtend);
      const std::vector<double> expected = slopes(kind, x, y);
      const auto slope_at = [&](double place) {
        return extended.value
            .evaluate<Taylor<double>>(
                {},
                [](double v) {
                  return Taylor<double>{v, 0, 0};
                },
                [&](const Variable&) {
                  return Taylor<double>{place, 1, 0};
                })
            .first;
      };
      for (const double beyond : {0.0, 0.5}) {
        EXPECT_NEAR(slope_at(x.front() - beyond), expected.front(), 1e-12) << n << " " << beyond;
        EXPECT_NEAR(slope_at(x.back() + beyond), expected.back(), 1e-11) << n << " " << beyond;
      }
    }
}

TEST(LookupTable, IsLinearInEachArgumentOnAGrid) {
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    LookupTable table{
        .name = "f",
        .axes = {{rising(random, 2 + random.below(5), 2)}, {rising(random, 2 + random.below(5), 2)}},
        .values = {},
        .beyond = Beyond::kExtend,
        .where = {}};
    const std::vector<double>&x = table.axes[0].points, &y = table.axes[1].points;
    std::vector<double> values;
    for (std::size_t k = 0; k < x.size() * y.size(); ++k) {
      values.push_back(random.uniform(-3, 3));
      table.values.emplace_back(values.back());
    }
    const Function function = table;
    for (int sample = 0; sample < 100; ++sample) {
      const double px = random.uniform(x.front() - 1, x.back() + 1),
                   py = random.uniform(y.front() - 1, y.back() + 1);
      const auto cell = [](const std::vector<double>& points, double p) {
        std::size_t k = 0;
        while (k + 2 < points.size() && p >= points[k + 1]) ++k;
        return k;
      };
      const std::size_t k = cell(x, px), l = cell(y, py);
      const double s = (px - x[k]) / (x[k + 1] - x[k]), t = (py - y[l]) / (y[l + 1] - y[l]);
      const auto value = [&](std::size_t a, std::size_t b) { return values[(k + a) * y.size() + l + b]; };
      const double expected =
          (1 - s) * ((1 - t) * value(0, 0) + t * value(0, 1)) + s * ((1 - t) * value(1, 0) + t * value(1, 1));
      EXPECT_NEAR(at(function, px, py), expected, 1e-9 * std::max(1.0, std::fabs(expected)));
    }
  }
}

TEST(LookupTable, MayHaveParametersForValues) {
  LookupTable table = curve({0, 2}, {0, 0}, Interpolation::kLinear);
  table.values[1] = Expression::parameter(ParameterIndex(0));
  EXPECT_EQ(at(table, 0.5, 0, {8}), 2);
  EXPECT_EQ(at(table, 3, 0, {-1}), -1);
}

std::size_t operations_in(const LookupTable& table) {
  const Function function = table;
  std::size_t count = 0;
  for (const Expression::Node& node : function.value.nodes())
    count += node.op != Expression::Op::kLiteral && node.op != Expression::Op::kVariable;
  return count;
}

TEST(LookupTable, CostsTheSameForAnyNumberOfPointsAtEqualDistances) {
  const auto size = [](std::size_t n, Interpolation kind) {
    std::vector<double> x, y;
    for (std::size_t k = 0; k < n; ++k) x.push_back(-3 + 0.1 * double(k)), y.push_back(std::sin(double(k)));
    return operations_in(curve(x, y, kind, Beyond::kExtend));
  };
  for (const std::size_t n : {5u, 30u, 1000u}) {
    EXPECT_EQ(size(n, Interpolation::kLinear), 8u) << n;
    EXPECT_EQ(size(n, Interpolation::kSpline), size(5, Interpolation::kSpline)) << n;
  }
  EXPECT_EQ(size(5, Interpolation::kSpline),
            14u + 2 + 7);  // clamped, straight ends, of which a difference is there
}

TEST(LookupTable, CostsFiveOperationsAStepOfTheSearchAtOtherDistances) {
  const auto size = [](std::size_t n) {
    std::vector<double> x, y;
    for (std::size_t k = 0; k < n; ++k) x.push_back(double(k * k)), y.push_back(std::sin(double(k)));
    return operations_in(curve(x, y, Interpolation::kLinear, Beyond::kExtend));
  };
  for (const std::size_t intervals : {5u, 16u, 17u, 600u})
    EXPECT_EQ(size(intervals + 1), 3 + 5 * std::size_t(std::bit_width(intervals - 1))) << intervals;
}

LookupTable grid(std::size_t rows, std::size_t columns, Interpolation kind) {
  LookupTable table{.name = "f", .axes = {{}, {}}, .values = {}, .interpolation = kind, .where = {}};
  for (std::size_t k = 0; k < rows; ++k) table.axes[0].points.push_back(1 + 0.1 * double(k));
  for (std::size_t k = 0; k < columns; ++k) table.axes[1].points.push_back(2 + 0.3 * double(k));
  for (std::size_t k = 0; k < rows * columns; ++k) table.values.emplace_back(std::sin(double(k) + 1));
  return table;
}

TEST(LookupTable, CostsTheSameForAnyGridOfEqualDistances) {
  for (const std::size_t n : {4u, 10u, 30u}) {
    EXPECT_EQ(operations_in(grid(n, n + 1, Interpolation::kLinear)), 13 + 8 + 4u) << n;
    EXPECT_EQ(operations_in(grid(n, n + 1, Interpolation::kSpline)), 37 + 20 + 4u) << n;
  }
}

TEST(LookupTable, CostsAFewOperationsAnIntervalWhereValuesAreParameters) {
  const auto size = [](std::size_t n) {
    std::vector<double> x, y;
    for (std::size_t k = 0; k < n; ++k) x.push_back(0.1 * double(k)), y.push_back(std::sin(double(k)));
    LookupTable table = curve(x, y, Interpolation::kLinear);
    table.values[1] = Expression::parameter(ParameterIndex(0));
    return operations_in(table);
  };
  EXPECT_EQ(size(40) - size(30), 60u);
}

/// 2 a value, 4 operations and 4 selections an interval; a row's first value is added to nothing, the row to others.
TEST(LookupTable, CostsTwoOperationsAValueOfAGridWhereOneIsAParameter) {
  const auto size = [](std::size_t n) {
    LookupTable table = grid(n, 10, Interpolation::kLinear);
    table.values[1] = Expression::parameter(ParameterIndex(0));
    return operations_in(table);
  };
  EXPECT_EQ(size(30) - size(20), 10 * (2 * 10u - 1 + 2 + 8));
}

/// The interval that x is in, of all.
std::size_t interval_of(const std::vector<double>& points, double x) {
  std::size_t k = 0;
  while (k + 2 < points.size() && x >= points[k + 1]) ++k;
  return k;
}

/// Hermite's formula, with slopes that other tests compare with those of SciPy.
double hermite(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& slope,
               double at) {
  const std::size_t k = interval_of(x, at);
  const double h = x[k + 1] - x[k], t = (at - x[k]) / h, s = 1 - t;
  return y[k] * (1 + 2 * t) * s * s + h * slope[k] * t * s * s + y[k + 1] * t * t * (3 - 2 * t) -
         h * slope[k + 1] * t * t * s;
}

TEST(LookupTable, FindsTheIntervalOfManyPoints) {
  Random random(6);
  for (const bool are_uniform : {false, true})
    for (const std::size_t n : {5u, 64u, 65u, 66u, 1000u}) {
      std::vector<double> x = rising(random, n, 2), y;
      if (are_uniform)
        for (std::size_t k = 0; k < n; ++k) x[k] = 0.1 + 1e-3 * double(k);
      for (std::size_t k = 0; k < n; ++k) y.push_back(random.uniform(-3, 3));
      const Function lines = curve(x, y, Interpolation::kLinear),
                     spline = curve(x, y, Interpolation::kSpline);
      ASSERT_TRUE(has_entries(curve(x, y, Interpolation::kLinear)));
      const std::vector<double> slope = slopes(Interpolation::kSpline, x, y);
      for (int sample = 0; sample < 300; ++sample) {
        const double at_x = sample < 50 ? x[random.below(n)] : random.uniform(x.front(), x.back());
        const std::size_t k = interval_of(x, at_x);
        const double line = y[k] + (y[k + 1] - y[k]) * (at_x - x[k]) / (x[k + 1] - x[k]);
        const double rounding = are_uniform ? 1e-10 : 1e-12 * (n / 5.0);
        EXPECT_NEAR(at(lines, at_x), line, rounding) << n << " " << at_x;
        EXPECT_NEAR(at(spline, at_x), hermite(x, y, slope, at_x), rounding) << n << " " << at_x;
      }
      for (const double far : {0.1, 1e300}) {
        EXPECT_EQ(at(spline, x[0] - far), y[0]);
        EXPECT_NEAR(at(lines, x[n - 1] + far), y[n - 1], 1e-11);
      }
    }
}

/// A natural spline in y of each row, then one in x of what those give, by curves.
TEST(LookupTable, IsASplineOfSplinesOnAGrid) {
  Random random(7);
  for (int i = 0; i < 30; ++i) {
    const std::vector<double> x = rising(random, 2 + random.below(9), 2),
                              y = rising(random, 2 + random.below(9), 2);
    LookupTable table{
        .name = "f", .axes = {{x}, {y}}, .values = {}, .interpolation = Interpolation::kSpline, .where = {}};
    std::vector<std::vector<double>> rows(x.size());
    for (std::vector<double>& row : rows)
      for (std::size_t k = 0; k < y.size(); ++k) {
        row.push_back(random.uniform(-3, 3));
        table.values.emplace_back(row.back());
      }
    const Function function = table;
    for (int sample = 0; sample < 50; ++sample) {
      const double px = random.uniform(x.front() - 0.2, x.back() + 0.2),
                   py = random.uniform(y.front() - 0.2, y.back() + 0.2);
      std::vector<double> in_y;
      for (const std::vector<double>& row : rows)
        in_y.push_back(at(curve(y, row, Interpolation::kSpline), py));
      const double expected = at(curve(x, in_y, Interpolation::kSpline), px);
      EXPECT_NEAR(at(function, px, py), expected, 1e-8 * std::max(1.0, std::fabs(expected)));
    }
  }
}

std::string model_with(const std::string& table, const std::string& force) {
  return "[model]\nname = \"m\"\n[[body]]\nname = \"b\"\nmass = 1\n[[joint]]\nname = \"j\"\ntype = "
         "\"prismatic\"\n"
         "parent = \"world\"\nchild = \"b\"\naxis = [1, 0, 0]\n" +
         table + "[[force]]\njoint = \"j\"\nvalue = \"" + force + "\"\n";
}

/// The force at position j and speed 3 of the only joint.
double force_of(const std::string& path, const std::string& text, double position) {
  support::Diagnostics diagnostics(path, text);
  const std::optional<Mechanism> mechanism = read_mechanism(diagnostics, {});
  EXPECT_EQ(diagnostics.format(), "");
  if (!mechanism) return 0;
  return mechanism->coordinate_forces.at(0).force.evaluate<double>(
      {}, [](double v) { return v; },
      [&](const Variable& v) { return v.kind == Variable::Kind::kPosition ? position : 3.0; });
}

TEST(LookupTable, IsReadInItsUnits) {
  const std::string text = model_with(
      "[[table]]\nname = \"f\"\nx = [0, 10, \"5 cm\"]\nx_unit = \"mm\"\nvalues = [1, 2, 0]\nunit = \"kN\"\n",
      "f(j) + f(j)");
  EXPECT_NEAR(force_of("m.toml", text, 0.005), 3000, 1e-9);
  EXPECT_NEAR(force_of("m.toml", text, 0.03), 2000, 1e-9);
  const std::string grid =
      model_with("[[table]]\nname = \"f\"\nx = [0, 1]\ny = [0, 3, 6]\nvalues = [[0, 1, 2], [10, 11, 12]]\n",
                 "f(j, 2*j.rate)");
  EXPECT_NEAR(force_of("m.toml", grid, 0.5), 7, 1e-14);
}

TEST(LookupTable, IsReadFromColumns) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path() + "/m.toml";
  support::write_file(folder.path() + "/line.csv", "speed, force\r\n0, 1\r\n1, 3\r\n\r\n2, 0\r\n");
  support::write_file(folder.path() + "/grid.csv", "x\\y, 0, 3\n-1, 0, 1\n1, 10, 11\n");
  EXPECT_EQ(force_of(path, model_with("[[table]]\nname = \"f\"\nfile = \"line.csv\"\n", "f(j)"), 0.5), 2);
  EXPECT_EQ(force_of(path, model_with("[[table]]\nname = \"f\"\nfile = \"grid.csv\"\n", "f(j, j.rate)"), 0),
            6);
}

}  // namespace
}  // namespace jourdain::model
