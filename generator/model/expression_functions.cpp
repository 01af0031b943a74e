#include "model/expression_functions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/composition.hpp"

namespace jourdain::model {

namespace {

using support::Function;
using Op = Expression::Op;
using Arguments = std::span<const Expression>;
using Dimensions = NamedFunction::Dimensions;

template <Op op>
Expression unary(Arguments x) {
  return Expression::unary(op, x[0]);
}

template <Function function>
Expression plain(Arguments x) {
  return support::facts_of(function).operands == 1 ? Expression::function(function, x[0])
                                                   : Expression::function(function, x[0], x[1]);
}

Expression tangent(Arguments x) { return Expression::tangent(x[0]); }
Expression power(Arguments x) { return real_power(x[0], x[1]); }
Expression arctangent(Arguments x) { return Expression::function(Function::kAtan2, x[0], 1.0); }

/// sqrt((1 − x) (1 + x)), the other side of the triangle.
std::size_t other_side(Composition& make) {
  const std::size_t one = make.literal(1);
  return make.operation(Op::kSqrt, make.product(make.difference(one, 0), make.sum(one, 0)));
}

Expression arcsine(Arguments x) {
  Composition make(x);
  make.function(Function::kAtan2, 0, other_side(make));
  return make.finish();
}

Expression arccosine(Arguments x) {
  Composition make(x);
  make.function(Function::kAtan2, other_side(make), 0);
  return make.finish();
}

Expression sign(Arguments x) {
  Composition make(x);
  const std::size_t below = make.function(Function::kWhereNegative, 0, make.literal(-1));
  const std::size_t above =
      make.function(Function::kWhereNegative, make.operation(Op::kNegate, 0), make.literal(1));
  make.sum(below, above);
  return make.finish();
}

/// x − m floor(x/m), in [0, m) for m > 0.
Expression modulo(Arguments x) {
  Composition make(x);
  const std::size_t whole = make.function(Function::kFloor, make.quotient(0, 1));
  make.difference(0, make.product(1, whole));
  return make.finish();
}

/// x / sqrt(x² + w²)
Expression smooth_sign(Arguments x) {
  Composition make(x);
  make.quotient(0, make.hypotenuse(0, 1));
  return make.finish();
}

/// (1 + x / sqrt(x² + w²)) / 2
Expression smooth_step(Arguments x) {
  Composition make(x);
  const std::size_t half = make.literal(0.5), slope = make.quotient(0, make.hypotenuse(0, 1));
  make.sum(half, make.product(half, slope));
  return make.finish();
}

/// sqrt(x² + w²)
Expression smooth_abs(Arguments x) {
  Composition make(x);
  make.hypotenuse(0, 1);
  return make.finish();
}

/// (a + b ± sqrt((a − b)² + w²)) / 2
template <Op op>
Expression smooth_extremum(Arguments x) {
  Composition make(x);
  const std::size_t half = make.literal(0.5), sum = make.sum(0, 1);
  const std::size_t distance = make.hypotenuse(make.difference(0, 1), 2);
  make.product(half, make.operation(op, sum, distance));
  return make.finish();
}

constexpr std::array<NamedFunction, 25> kFunctions = {{
    {"sqrt", "x", 1, Dimensions::kRoot, unary<Op::kSqrt>},
    {"sin", "x", 1, Dimensions::kAngle, unary<Op::kSin>},
    {"cos", "x", 1, Dimensions::kAngle, unary<Op::kCos>},
    {"tan", "x", 1, Dimensions::kAngle, tangent},
    {"asin", "x", 1, Dimensions::kPure, arcsine},
    {"acos", "x", 1, Dimensions::kPure, arccosine},
    {"atan", "x", 1, Dimensions::kPure, arctangent},
    {"atan2", "y, x", 2, Dimensions::kRatio, plain<Function::kAtan2>},
    {"exp", "x", 1, Dimensions::kPure, plain<Function::kExp>},
    {"log", "x", 1, Dimensions::kPure, plain<Function::kLog>},
    {"sinh", "x", 1, Dimensions::kPure, plain<Function::kSinh>},
    {"cosh", "x", 1, Dimensions::kPure, plain<Function::kCosh>},
    {"tanh", "x", 1, Dimensions::kPure, plain<Function::kTanh>},
    {"pow", "x, exponent", 2, Dimensions::kPower, power},
    {"abs", "x", 1, Dimensions::kKept, plain<Function::kAbs>},
    {"sign", "x", 1, Dimensions::kSign, sign},
    {"floor", "x", 1, Dimensions::kKept, plain<Function::kFloor>},
    {"mod", "x, divisor", 2, Dimensions::kCommon, modulo},
    {"min", "a, b", 2, Dimensions::kCommon, plain<Function::kMin>},
    {"max", "a, b", 2, Dimensions::kCommon, plain<Function::kMax>},
    {"smooth_abs", "x, width", 2, Dimensions::kCommon, smooth_abs},
    {"smooth_sign", "x, width", 2, Dimensions::kRatio, smooth_sign},
    {"smooth_step", "x, width", 2, Dimensions::kRatio, smooth_step},
    {"smooth_min", "a, b, width", 3, Dimensions::kCommon, smooth_extremum<Op::kSubtract>},
    {"smooth_max", "a, b, width", 3, Dimensions::kCommon, smooth_extremum<Op::kAdd>},
}};

}  // namespace

const NamedFunction* find_function(std::string_view name) {
  const auto* const found = std::find_if(kFunctions.begin(), kFunctions.end(),
                                         [name](const NamedFunction& f) { return f.name == name; });
  return found == kFunctions.end() ? nullptr : found;
}

bool is_expression_word(std::string_view word) {
  return word == "pi" || word == "deg" || word == "if" || find_function(word) != nullptr;
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const NamedFunction& function : kFunctions) names.emplace_back(function.name);
  names.emplace_back("if");
  return names;
}

Expression where_less(const Expression& a, const Expression& b, bool or_equal, const Expression& x,
                      const Expression& y) {
  const Expression difference =
      or_equal ? Expression::binary(Op::kSubtract, b, a) : Expression::binary(Op::kSubtract, a, b);
  const Function where_x = or_equal ? Function::kWhereNotNegative : Function::kWhereNegative;
  const Function where_y = or_equal ? Function::kWhereNegative : Function::kWhereNotNegative;
  if (difference.is_constant()) return (difference.constant() < 0) != or_equal ? x : y;
  if (y.is_zero()) return Expression::function(where_x, difference, x);
  if (x.is_zero()) return Expression::function(where_y, difference, y);
  const std::array<Expression, 3> arguments = {difference, x, y};
  Composition make(arguments);
  const std::size_t taken = make.function(where_x, 0, 1);
  make.sum(taken, make.function(where_y, 0, 2));
  return make.finish();
}

Expression real_power(const Expression& base, const Expression& exponent) {
  constexpr double kMaximumExponent = 64;
  if (exponent.is_constant()) {
    const double p = exponent.constant();
    if (p == 0.5) return Expression::unary(Op::kSqrt, base);
    if (p == std::floor(p) && std::fabs(p) <= kMaximumExponent)
      return Expression::power(base, static_cast<int>(p));
  }
  return Expression::function(Function::kPower, base, exponent);
}

Measure measure_of(Dimensions dimensions, const Measure& argument) {
  if (dimensions == Dimensions::kRoot) return argument.square_root();
  const bool is_same = dimensions == Dimensions::kKept || dimensions == Dimensions::kCommon;
  return is_same ? argument : Measure::ratio_of(argument);
}

Measure measure_of_power(const Measure& base, const Expression& exponent, const Measure& of_exponent) {
  if (!exponent.is_constant()) return Measure::ratio_of(base).times(Measure::ratio_of(of_exponent));
  const double p = exponent.constant();
  if (p == 0.5) return base.square_root();
  return base.power(p);
}

}  // namespace jourdain::model
