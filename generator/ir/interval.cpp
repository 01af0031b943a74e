#include "ir/interval.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>

namespace jourdain::ir {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;
/// Beyond it an angle is not reduced to its place in the circle.
constexpr double kLargestAngle = 1e6;
/// Of a quarter turn: an extremum this near to an end counts as inside, which covers the rounding of the reduction.
constexpr double kQuarterSlack = 1e-8;
constexpr int kFunctionUnits = 4;

/// The next double towards −∞, as of std::nextafter, which is a call: half of what a proof by boxes would take.
inline double next_below(double x) {
  if (x == 0) return -std::numeric_limits<double>::denorm_min();
  if (!(x > -kInfinity)) return x;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) +
                               (x > 0 ? ~std::uint64_t{0} : std::uint64_t{1}));
}

inline double below(double x, int units = 1) {
  for (; units > 0; --units) x = next_below(x);
  return x;
}

inline double above(double x, int units = 1) { return -below(-x, units); }

/// The smallest interval with all of `values`, widened by `units` of the last place; the line where one is not
/// a number.
inline Interval around(std::initializer_list<double> values, int units = 1) {
  Interval result{kInfinity, -kInfinity};
  bool is_number = true;
  for (const double value : values) {
    is_number = is_number && value == value;
    result.low = std::min(result.low, value);
    result.high = std::max(result.high, value);
  }
  if (!is_number) return Interval::line();
  return {below(result.low, units), above(result.high, units)};
}

Interval negated(Interval a) { return {-a.high, -a.low}; }

Interval square(Interval a) {
  const Interval ends = around({a.low * a.low, a.high * a.high});
  return {a.contains(0) ? 0 : std::max(0.0, ends.low), ends.high};
}

Interval quotient(Interval a, Interval b) {
  if (b.contains(0)) return Interval::line();
  return around({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
}

Interval root(Interval a) {
  const Interval ends = around({std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0))});
  return {std::max(ends.low, 0.0), ends.high};
}

/// Is there a whole number k with quarter turns `offset` + 4 k inside?
bool has_quarter(Interval angle, double offset) {
  const double low = (angle.low / (kPi / 2) - offset) / 4 - kQuarterSlack,
               high = (angle.high / (kPi / 2) - offset) / 4 + kQuarterSlack;
  return std::ceil(low) <= std::floor(high);
}

/// `maximum`: the quarter turn of the value 1; −1 is two quarters later.
Interval wave(Interval angle, double (*function)(double), double maximum) {
  if (!(std::max(std::fabs(angle.low), std::fabs(angle.high)) <= kLargestAngle)) return {-1, 1};
  Interval result = around({function(angle.low), function(angle.high)}, kFunctionUnits);
  if (has_quarter(angle, maximum)) result.high = 1;
  if (has_quarter(angle, maximum + 2)) result.low = -1;
  return {std::max(result.low, -1.0), std::min(result.high, 1.0)};
}

double sine(double x) { return std::sin(x); }
double cosine(double x) { return std::cos(x); }

/// On a box without the cut, which runs from the origin along negative b, the angle is largest and least at corners.
Interval angle(Interval a, Interval b) {
  if (a.contains(0) && b.low <= 0) return {below(-kPi), above(kPi)};
  return around({std::atan2(a.low, b.low), std::atan2(a.low, b.high), std::atan2(a.high, b.low),
                 std::atan2(a.high, b.high)},
                kFunctionUnits);
}

Interval rising(Interval a, double (*function)(double)) {
  return around({function(a.low), function(a.high)}, kFunctionUnits);
}

/// What is taken where a sign says so, or zero.
Interval taken(bool may_be, bool must_be, Interval value) {
  if (must_be) return value;
  return may_be ? Interval{std::min(value.low, 0.0), std::max(value.high, 0.0)} : Interval::point(0);
}

/// All entries whose numbers are in `a`, of the array with the number `array`.
Interval entries(Interval a, Interval array) {
  const std::vector<double>& values =
      support::array_of(support::whole_part(array.low, support::kLargestArrayNumber));
  const auto last = static_cast<std::uint32_t>(values.size() - 1);
  const auto [low, high] = std::minmax_element(values.begin() + support::whole_part(a.low, last),
                                               values.begin() + support::whole_part(a.high, last) + 1);
  return {*low, *high};
}

/// Where they exist.
Interval function_of(Op op, Interval a, Interval b) {
  const auto size = [&a] {
    const double largest = std::max(std::fabs(a.low), std::fabs(a.high));
    return Interval{a.contains(0) ? 0 : std::min(std::fabs(a.low), std::fabs(a.high)), largest};
  };
  switch (op) {
    case Op::kExp: {
      const Interval value = rising(a, [](double x) { return std::exp(x); });
      return {std::max(value.low, 0.0), value.high};
    }
    case Op::kLog:
      return a.high < 0 ? Interval::line()
                        : rising({std::max(a.low, 0.0), a.high}, [](double x) { return std::log(x); });
    case Op::kSinh:
      return rising(a, [](double x) { return std::sinh(x); });
    case Op::kCosh: {
      const Interval value = rising(size(), [](double x) { return std::cosh(x); });
      return {std::max(value.low, 1.0), value.high};
    }
    case Op::kTanh: {
      const Interval value = rising(a, [](double x) { return std::tanh(x); });
      return {std::max(value.low, -1.0), std::min(value.high, 1.0)};
    }
    case Op::kPower: {
      if (a.high < 0) return Interval::line();
      const double low = std::max(a.low, 0.0);
      const Interval value = around(
          {std::pow(low, b.low), std::pow(low, b.high), std::pow(a.high, b.low), std::pow(a.high, b.high)},
          kFunctionUnits);  // the logarithm is bilinear in b and log a
      return {std::max(value.low, 0.0), value.high};
    }
    case Op::kAbs:
      return size();
    case Op::kFloor:
      return {std::floor(a.low), std::floor(a.high)};
    case Op::kMin:
      return {std::min(a.low, b.low), std::min(a.high, b.high)};
    case Op::kMax:
      return {std::max(a.low, b.low), std::max(a.high, b.high)};
    case Op::kWhereNegative:
      return taken(a.low < 0, a.high < 0, b);
    case Op::kWhereNotNegative:
      return taken(a.high >= 0, a.low >= 0, b);
    case Op::kEntry:
      return entries(a, b);
    default:
      return Interval::line();
  }
}

bool undefined(const Node& node, Interval a, Interval b) {
  switch (node.op) {
    case Op::kSqrt:
      return a.low < 0;
    case Op::kDivide:
      return b.contains(0);
    case Op::kAtan2:
      return a.contains(0) && b.contains(0);
    case Op::kLog:
      return a.low <= 0;
    case Op::kPower:
      return a.low < 0 || (a.contains(0) && b.low <= 0);
    case Op::kLiteral:
    case Op::kLeaf:
    case Op::kNegate:
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
    case Op::kSin:
    case Op::kCos:
    default:
      break;
  }
  return false;
}

Interval evaluated(const Node& node, Interval a, Interval b) {
  switch (node.op) {
    case Op::kLiteral:
    case Op::kLeaf:
      break;
    case Op::kNegate:
      return negated(a);
    case Op::kAdd:
      return a + b;
    case Op::kSubtract:
      return a - b;
    case Op::kMultiply:
      return node.a == node.b ? square(a) : a * b;
    case Op::kDivide:
      return quotient(a, b);
    case Op::kSqrt:
      return root(a);
    case Op::kSin:
      return wave(a, sine, 1);
    case Op::kCos:
      return wave(a, cosine, 0);
    case Op::kAtan2:
      return angle(a, b);
    default:
      return function_of(node.op, a, b);
  }
  return Interval::point(node.literal);
}

}  // namespace

Interval operator+(Interval a, Interval b) {
  const double low = a.low + b.low, high = a.high + b.high;
  return std::isnan(low) || std::isnan(high) ? Interval::line() : Interval{below(low), above(high)};
}

Interval operator-(Interval a, Interval b) { return a + negated(b); }

Interval operator*(Interval a, Interval b) {
  return around({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}

IntervalResults interpret_interval(const Program& program, const LeafValues<Interval>& leaves) {
  const std::size_t count = program.nodes.size();
  std::vector<Interval> value(count);
  std::vector<char> maybe_undefined(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Node& node = program.nodes[i];
    if (node.op == Op::kLeaf) {
      JD_CHECK(node.index < leaves[node.leaf].size(), "{}[{}]", leaf_name(node.leaf), node.index);
      value[i] = leaves[node.leaf][node.index];
      continue;
    }
    const int operands = operand_count(node.op);
    const Interval a = operands >= 1 ? value[node.a.value] : Interval{},
                   b = operands == 2 ? value[node.b.value] : Interval{};
    value[i] = evaluated(node, a, b);
    maybe_undefined[i] = (operands >= 1 && maybe_undefined[node.a.value] != 0) ||
                         (operands == 2 && maybe_undefined[node.b.value] != 0) || undefined(node, a, b);
  }
  IntervalResults results;
  for (const Output& output : program.outputs) {
    results.values.push_back(value[output.value.value]);
    results.maybe_undefined.push_back(maybe_undefined[output.value.value] != 0);
  }
  return results;
}

}  // namespace jourdain::ir
