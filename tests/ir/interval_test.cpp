#include "ir/program_intervals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "ir/builder.hpp"
#include "properties/random.hpp"

namespace jourdain::ir {
namespace {

using support::Interval;
using tests::Random;

constexpr std::size_t kLeaves = 3;

/// The interval of an operation of position 0 and position 1.
IntervalResults results_of(const std::function<Signed(Builder&, Signed, Signed)>& operation, Interval a,
                           Interval b = {}) {
  Builder builder;
  const Signed x = builder.leaf(LeafKind::kPosition, 0), y = builder.leaf(LeafKind::kPosition, 1);
  builder.output("r", 0, -1, operation(builder, x, y));
  LeafValues<Interval> leaves;
  leaves[LeafKind::kPosition] = {a, b};
  return interpret_interval(builder.finish("r"), leaves);
}

Interval of(const std::function<Signed(Builder&, Signed, Signed)>& operation, Interval a, Interval b = {}) {
  return results_of(operation, a, b).values[0];
}

Signed sine(Builder& b, Signed x, Signed) { return b.unary(Op::kSin, x); }
Signed cosine(Builder& b, Signed x, Signed) { return b.unary(Op::kCos, x); }
Signed root(Builder& b, Signed x, Signed) { return b.unary(Op::kSqrt, x); }
Signed quotient(Builder& b, Signed x, Signed y) { return b.divide(x, y); }
Signed product(Builder& b, Signed x, Signed y) { return b.multiply(x, y); }
Signed angle(Builder& b, Signed x, Signed y) { return b.atan2(x, y); }

void expect_close(Interval value, double low, double high) {
  EXPECT_LE(value.low, low);
  EXPECT_GE(value.high, high);
  EXPECT_NEAR(value.low, low, 1e-14);
  EXPECT_NEAR(value.high, high, 1e-14);
}

TEST(Interval, IsRoundedOutwardToTheNextDouble) {
  constexpr double infinity = std::numeric_limits<double>::infinity(),
                   largest = std::numeric_limits<double>::max(),
                   least = std::numeric_limits<double>::denorm_min(),
                   normal = std::numeric_limits<double>::min();
  for (const double x : {0.0, -0.0, 1.0, -1.0, 1.5, -1.5, 2.0, least, -least, normal, -normal, largest,
                         -largest, 1e-310, 3e17}) {
    const Interval sum = Interval::point(x) + Interval::point(0);
    EXPECT_EQ(sum.low, std::nextafter(x, -infinity)) << x;
    EXPECT_EQ(sum.high, std::nextafter(x, infinity)) << x;
  }
  const Interval beyond = Interval::point(largest) + Interval::point(largest);
  EXPECT_EQ(beyond.low, largest);
  EXPECT_EQ(beyond.high, infinity);
  EXPECT_EQ(Interval::line() * Interval::point(0), Interval::line());
}

TEST(Interval, OfAWaveHasItsExtremaWhereTheyAreInside) {
  expect_close(of(sine, {0.1, 0.2}), std::sin(0.1), std::sin(0.2));
  expect_close(of(sine, {1, 3}), std::sin(3), 1);
  expect_close(of(sine, {-3, 1}), -1, std::sin(1));
  expect_close(of(sine, {1e3, 1e3 + 7}), -1, 1);
  expect_close(of(cosine, {-0.1, 0.2}), std::cos(0.2), 1);
  expect_close(of(cosine, {3, 4}), -1, std::cos(4));
  expect_close(of(cosine, {100.4, 100.5}), std::cos(100.4), std::cos(100.5));
  expect_close(of(cosine, Interval::line()), -1, 1);
  expect_close(of(sine, {1e9, 1e9}), -1, 1);
}

TEST(Interval, OfASquareIsNotNegative) {
  expect_close(of([](Builder& b, Signed x, Signed) { return b.multiply(x, x); }, {-2, 1}), 0, 4);
  expect_close(of(product, {-2, 1}, {-2, 1}), -2, 4);
  expect_close(of(product, {-2, -1}, {3, 5}), -10, -3);
}

TEST(Interval, SaysWhereAValueMayBeMissing) {
  EXPECT_EQ(of(quotient, {1, 2}, {-1, 1}), Interval::line());
  EXPECT_TRUE(results_of(quotient, {1, 2}, {-1, 1}).maybe_undefined[0]);
  EXPECT_TRUE(results_of(root, {-1, 4}).maybe_undefined[0]);
  expect_close(of(root, {-1, 4}), 0, 2);
  EXPECT_FALSE(results_of(root, {1, 4}).maybe_undefined[0]);
  EXPECT_TRUE(results_of(angle, {-1, 1}, {-1, 1}).maybe_undefined[0]);
  EXPECT_FALSE(results_of(angle, {-1, 1}, {-2, -1}).maybe_undefined[0]);
  // What does not need the root is defined.
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0);
  b.output("r", 0, -1, b.unary(Op::kSqrt, x));
  b.output("r", 1, -1, b.add(x, x));
  LeafValues<Interval> leaves;
  leaves[LeafKind::kPosition] = {{-1, 1}};
  EXPECT_EQ(interpret_interval(b.finish("two"), leaves).maybe_undefined, (std::vector<bool>{true, false}));
}

TEST(Interval, OfAnAngleIsWholeAtItsCutOnly) {
  const double pi = std::acos(-1.0);
  expect_close(of(angle, {-1, 1}, {-2, -1}), -pi, pi);
  expect_close(of(angle, {-1, 1}, {1, 2}), -pi / 4, pi / 4);
  expect_close(of(angle, {1, 2}, {-1, 1}), pi / 4, 3 * pi / 4);
  expect_close(of(angle, {1, 2}, {-2, -1}), std::atan2(2, -1), std::atan2(1, -2));
}

/// Every operation of leaves, literals and earlier results; angles on request, for they jump.
Program random_program(Random& random, bool angles) {
  Builder b;
  std::vector<Signed> values = {b.literal(1.5), b.literal(-0.3)};
  for (std::size_t i = 0; i < kLeaves; ++i) values.push_back(b.leaf(LeafKind::kPosition, i));
  const auto any = [&] {
    const Signed value = values[random.below(values.size())];
    return random.chance(0.3) ? -value : value;
  };
  for (int i = 0; i < 25; ++i) {
    const Signed x = any(), y = any();
    switch (random.below(8)) {
      case 0:
        values.push_back(b.unary(Op::kSin, x));
        break;
      case 1:
        values.push_back(b.unary(Op::kCos, x));
        break;
      case 2:
        values.push_back(b.unary(Op::kSqrt, x));
        break;
      case 3:
        values.push_back(b.divide(x, y));
        break;
      case 4:
        values.push_back(angles ? b.atan2(x, y) : b.subtract(x, y));
        break;
      case 5:
        values.push_back(b.multiply(x, y));
        break;
      default:
        values.push_back(b.add(x, y));
        break;
    }
  }
  for (std::size_t i = 0; i < 4; ++i) b.output("r", int(i), -1, values[values.size() - 1 - i]);
  return b.finish("random");
}

TEST(Interval, HoldsEveryPointOfItsBox) {
  std::size_t points = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    const Program program = random_program(random, true);
    LeafValues<Interval> box;
    for (std::size_t i = 0; i < kLeaves; ++i) {
      const double low = random.uniform(-3, 3);
      box[LeafKind::kPosition].push_back({low, low + random.uniform(0, random.chance(0.5) ? 0.01 : 3)});
    }
    const IntervalResults results = interpret_interval(program, box);
    for (int k = 0; k < 20; ++k) {
      LeafValues<long double> leaves;
      for (const Interval side : box[LeafKind::kPosition])
        leaves[LeafKind::kPosition].push_back(random.uniform(side.low, side.high));
      const std::vector<long double> values = interpret(program, leaves);
      for (std::size_t r = 0; r < values.size(); ++r) {
        if (!std::isfinite(values[r])) {
          EXPECT_TRUE(results.maybe_undefined[r]) << print(program);
          continue;
        }
        // A value computed where another one is missing is no value either.
        const long double slack = 1e-17L * std::fabs(values[r]);
        EXPECT_LE(results.values[r].low, values[r] + slack) << seed << "\n" << print(program);
        EXPECT_GE(results.values[r].high, values[r] - slack) << seed << "\n" << print(program);
        ++points;
      }
    }
  }
  EXPECT_GT(points, 100000u);
}

TEST(Interval, ShrinksToThePointWithItsBox) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const Program program = random_program(random, false);
    LeafValues<Interval> box;
    LeafValues<double> point;
    for (std::size_t i = 0; i < kLeaves; ++i) {
      point[LeafKind::kPosition].push_back(random.uniform(-3, 3));
      box[LeafKind::kPosition].push_back(Interval::point(point[LeafKind::kPosition][i]));
    }
    const IntervalResults results = interpret_interval(program, box);
    const std::vector<double> values = interpret(program, point);
    for (std::size_t r = 0; r < values.size(); ++r) {
      if (results.maybe_undefined[r] || !(std::fabs(values[r]) < 100)) continue;
      EXPECT_LT(results.values[r].width(), 1e-7) << print(program);
    }
  }
}

}  // namespace
}  // namespace jourdain::ir
