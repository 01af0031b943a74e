// Functions in programs: derivatives, enclosures, and that zero times what has no value is not taken.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "ir/jacobian.hpp"
#include "ir/program_intervals.hpp"
#include "support/elementary_functions.hpp"
#include "support/uniform.hpp"

namespace jourdain::ir {
namespace {

using support::Function;
using support::Interval;
using support::ScaledReal;

/// But calls of user code, which have lists of arguments.
std::vector<Function> all_functions() {
  std::vector<Function> list;
  for (std::size_t i = 0; i < support::kFunctions; ++i)
    if (!support::is_opaque(static_cast<Function>(i))) list.push_back(static_cast<Function>(i));
  return list;
}

/// y1, or the number of an array.
Signed second_operand(Builder& builder, Function function) {
  if (function != Function::kEntry) return builder.leaf(LeafKind::kPosition, 1);
  return builder.literal(support::number_of_array(std::vector<double>{0.5, -1, 2, 0.25}));
}

Surroundings with_forward(std::optional<double> forward) {
  Surroundings surroundings;
  surroundings.forward = forward;
  return surroundings;
}

/// f(y0, y1), and its two derivatives behind it.
Program with_slopes(Function function) {
  Builder builder;
  const Signed a = builder.leaf(LeafKind::kPosition, 0), b = builder.leaf(LeafKind::kPosition, 1);
  const Signed value = builder.function(function, a, second_operand(builder, function)),
               one = builder.literal(1);
  builder.output("f", 0, -1, value);
  const JacobianEntries J = differentiate(builder, {value}, {{a, 0, one}, {b, 1, one}});
  for (std::size_t column = 0; column < 2; ++column) {
    const auto it = J.find({0, column});
    builder.output("J", 0, int(column), it == J.end() ? builder.literal(0) : it->second);
  }
  return builder.finish("f");
}

template <class Real>
std::vector<Real> at(const Program& program, const Real& a, const Real& b) {
  LeafValues<Real> leaves;
  leaves[LeafKind::kPosition] = {a, b};
  return interpret(program, leaves);
}

/// Away from kinks by more than the difference.
bool is_smooth(Function function, double a, double b) {
  const double near = function == Function::kMin || function == Function::kMax       ? a - b
                      : function == Function::kFloor || function == Function::kEntry ? a - std::round(a)
                                                                                     : a;
  return !support::facts_of(function).has_kinks || std::fabs(near) > 1e-3;
}

TEST(Functions, HaveTheDerivativesOfDifferencesInSeventyDigits) {
  support::Uniform uniform(7);
  for (const Function function : all_functions()) {
    const Program program = with_slopes(function);
    int compared = 0;
    for (int k = 0; k < 40; ++k) {
      const bool is_positive = function == Function::kLog || function == Function::kPower;
      const double a = is_positive ? uniform(0.1, 3) : uniform(-3, 3), b = uniform(-2, 2);
      if (!is_smooth(function, a, b)) continue;
      const ScaledReal h(1e-20);
      const auto f = [&](const ScaledReal& x, const ScaledReal& y) { return at(program, x, y)[0]; };
      const ScaledReal x(a), y(b);
      const auto by_a = double((f(x + h, y) - f(x - h, y)) / (h + h)),
                 by_b = double((f(x, y + h) - f(x, y - h)) / (h + h));
      const std::vector<double> found = at(program, a, b);
      EXPECT_NEAR(found[1], by_a, 4e-15 * (1 + std::fabs(by_a)))
          << support::facts_of(function).name << " " << a << " " << b;
      EXPECT_NEAR(found[2], by_b, 4e-15 * (1 + std::fabs(by_b)))
          << support::facts_of(function).name << " " << a << " " << b;
      ++compared;
    }
    EXPECT_GT(compared, 30) << support::facts_of(function).name;
  }
}

/// f(y0, 2, y0 y1), a call; its derivatives by y0 and y1, and that by y0 and then y1.
Program with_slopes_of_a_call() {
  Builder builder;
  const Signed a = builder.leaf(LeafKind::kPosition, 0), b = builder.leaf(LeafKind::kPosition, 1),
               one = builder.literal(1);
  Signed list = builder.literal(0);
  for (const Signed& argument : {a, builder.literal(2), builder.multiply(a, b)})
    list = builder.function(Function::kArgument, argument, list);
  const double number = support::number_of_called({"f", {"x", "y", "z"}});
  const Signed value = builder.function(Function::kCall, list, builder.literal(number));
  const JacobianEntries J = differentiate(builder, {value}, {{a, 0, one}, {b, 1, one}}, {});
  const JacobianEntries H = differentiate(builder, {J.at({0, 0})}, {{b, 0, one}}, {});
  builder.output("f", 0, -1, value);
  builder.output("J", 0, 0, J.at({0, 0}));
  builder.output("J", 0, 1, J.at({0, 1}));
  builder.output("H", 0, 0, H.at({0, 0}));
  return builder.finish("f");
}

TEST(Functions, CallsHaveThePartialDerivativesOfWhatStandsIn) {
  const Program program = with_slopes_of_a_call();
  const ScaledReal h(1e-20), x(0.7), y(-1.3);
  const auto at_point = [&](const ScaledReal& a, const ScaledReal& b, std::size_t output) {
    return at(program, a, b)[output];
  };
  const auto by_x = double((at_point(x + h, y, 0) - at_point(x - h, y, 0)) / (h + h)),
             by_y = double((at_point(x, y + h, 0) - at_point(x, y - h, 0)) / (h + h)),
             by_xy = double((at_point(x, y + h, 1) - at_point(x, y - h, 1)) / (h + h));
  const std::vector<double> found = at(program, 0.7, -1.3);
  EXPECT_NEAR(found[1], by_x, 1e-14);
  EXPECT_NEAR(found[2], by_y, 1e-14);
  EXPECT_NEAR(found[3], by_xy, 1e-14);
  for (const double slope : {by_x, by_y, by_xy}) EXPECT_GT(std::fabs(slope), 1e-3);
}

TEST(Functions, StandInsDependOnEveryArgumentAndTheName) {
  const auto value = [](const support::CalledFunction& function, const std::vector<double>& arguments) {
    double list = 0;
    for (const double argument : arguments) list = support::value_of(Function::kArgument, argument, list);
    return support::value_of(Function::kCall, list, double(support::number_of_called(function)));
  };
  const support::CalledFunction f{"f", {"x", "y", "z"}}, g{"g", {"x", "y", "z"}};
  const std::vector<double> point = {0.3, -0.8, 1.1};
  EXPECT_GT(std::fabs(value(f, point) - value(g, point)), 1e-3);
  EXPECT_GT(value(f, point), 1);
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> moved = point;
    moved[k] += 0.1;
    EXPECT_GT(std::fabs(value(f, moved) - value(f, point)), 1e-3) << k;
    for (std::size_t other = 0; other < k; ++other) {
      std::vector<double> exchanged = point;
      std::swap(exchanged[k], exchanged[other]);
      EXPECT_GT(std::fabs(value(f, exchanged) - value(f, point)), 1e-3) << k << " " << other;
    }
  }
}

TEST(Functions, TakeEntriesUpToTheEndsOfAnArray) {
  const Program program = with_slopes(Function::kEntry);
  for (const auto& [place, value] :
       {std::pair{-7.0, 0.5}, {-0.0, 0.5}, {0.0, 0.5}, {1.0, -1.0}, {2.0, 2.0}, {3.0, 0.25}, {1e300, 0.25}}) {
    EXPECT_EQ(at(program, place, 0.0)[0], value) << place;
    EXPECT_EQ(at(program, float(place), 0.0f)[0], float(value)) << place;
    EXPECT_EQ(at(program, ScaledReal(place), ScaledReal(0))[0], ScaledReal(value)) << place;
  }
}

TEST(Functions, AreEnclosed) {
  support::Uniform uniform(11);
  for (const Function function : all_functions()) {
    Builder builder;
    builder.output(
        "f", 0, -1,
        builder.function(function, builder.leaf(LeafKind::kPosition, 0), second_operand(builder, function)));
    const Program program = builder.finish("f");
    for (int k = 0; k < 300; ++k) {
      const double size = k % 3 == 0 ? 1e-3 : 1.0;
      const auto side = [&] {
        const double low = uniform(-2.5, 2.5);
        return Interval{low, low + size * uniform(0, 2)};
      };
      const Interval a = side(), b = side();
      const IntervalResults box = interpret_interval(program, [&] {
        LeafValues<Interval> leaves;
        leaves[LeafKind::kPosition] = {a, b};
        return leaves;
      }());
      for (int i = 0; i < 20; ++i) {
        const double x = i == 0   ? a.low
                         : i == 1 ? a.high
                                  : uniform(a.low, a.high),
                     y = i == 0   ? b.high
                         : i == 1 ? b.low
                                  : uniform(b.low, b.high);
        const ScaledReal exact = at(program, ScaledReal(x), ScaledReal(y))[0];
        if (!exact.is_number()) {
          EXPECT_TRUE(box.maybe_undefined[0]) << support::facts_of(function).name << " " << x << " " << y;
          continue;
        }
        const auto value = static_cast<long double>(exact);
        EXPECT_TRUE(box.values[0].low <= value && value <= box.values[0].high)
            << support::facts_of(function).name << " at " << x << ", " << y << ": " << double(exact)
            << " outside " << box.values[0].low << " " << box.values[0].high;
      }
    }
  }
}

/// f = x where d < 0 else 0 for an x that has no value, nor derivatives, where it is not taken.
TEST(Functions, TakeNothingOfDerivativesThatDoNotExist) {
  using Forward = std::optional<double>;
  for (const Forward forward : {Forward{}, Forward{0}, Forward{0.3}, Forward{0.7}, Forward{1}}) {
    Builder b;
    const Signed y = b.leaf(LeafKind::kPosition, 0), one = b.literal(1);
    const Signed root = b.unary(Op::kSqrt, b.multiply(y, b.literal(3)));
    const std::vector<Signed> values = {
        b.function(Function::kWhereNegative, -y, root),
        b.multiply(b.function(Function::kWhereNegative, -y, b.multiply(root, root)), b.literal(5)),
        b.function(Function::kWhereNotNegative, y, b.function(Function::kLog, y, y)),
        b.unary(Op::kSin, b.function(Function::kWhereNegative, -y, b.divide(one, root))),
        b.multiply(b.add(b.function(Function::kWhereNegative, -y, b.multiply(root, y)),
                         b.function(Function::kWhereNegative, b.subtract(one, y), b.divide(y, root))),
                   b.add(y, b.unary(Op::kSin, y)))};
    const JacobianEntries J = differentiate(b, values, {{y, 0, one}}, {}, with_forward(forward));
    for (std::size_t row = 0; row < values.size(); ++row) {
      const auto it = J.find({row, 0});
      b.output("J", int(row), 0, it == J.end() ? b.literal(0) : it->second);
    }
    const Program program = b.finish("J");
    for (const double slope : at(program, -2.0, 0.0)) EXPECT_EQ(slope, 0) << forward.value_or(-1);
    EXPECT_NEAR(at(program, 2.0, 0.0)[0], 0.5 * std::sqrt(3 / 2.0), 1e-15);
  }
}

TEST(Functions, FollowTheirSignsAndLiterals) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0);
  const auto same = [](Signed p, Signed q) { return p.value == q.value && p.negative == q.negative; };
  EXPECT_TRUE(same(b.function(Function::kTanh, -x, x), -b.function(Function::kTanh, x, x)));
  EXPECT_TRUE(same(b.function(Function::kCosh, -x, x), b.function(Function::kCosh, x, x)));
  EXPECT_TRUE(same(b.function(Function::kAbs, -x, x), b.function(Function::kAbs, x, x)));
  EXPECT_FALSE(same(b.function(Function::kExp, -x, x), b.function(Function::kExp, x, x)));
  EXPECT_TRUE(same(b.function(Function::kWhereNegative, b.literal(-1), x), x));
  EXPECT_TRUE(b.is_literal(b.function(Function::kWhereNegative, b.literal(1), x), 0));
  EXPECT_TRUE(same(b.function(Function::kWhereNegative, x, -x), -b.function(Function::kWhereNegative, x, x)));
}

}  // namespace
}  // namespace jourdain::ir
