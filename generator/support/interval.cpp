#include "support/interval.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace jourdain::support {

namespace {

constexpr double kPi = std::numbers::pi;
/// Beyond it an angle is not reduced to its place in the circle.
constexpr double kLargestAngle = 1e6;
/// Of a quarter turn: an extremum this near to an end counts as inside, which covers the rounding of the reduction.
constexpr double kQuarterSlack = 1e-8;
constexpr int kFunctionUnits = 4;

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
  const std::vector<double>& values = array_of(whole_part(array.low, kLargestArrayNumber));
  const auto last = static_cast<std::uint32_t>(values.size() - 1);
  const auto [low, high] = std::minmax_element(values.begin() + whole_part(a.low, last),
                                               values.begin() + whole_part(a.high, last) + 1);
  return {*low, *high};
}

}  // namespace

Interval sqrt(Interval a) {
  const Interval ends = around({std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0))});
  return {std::max(ends.low, 0.0), ends.high};
}

Interval sin(Interval a) {
  return wave(
      a, [](double x) { return std::sin(x); }, 1);
}

Interval cos(Interval a) {
  return wave(
      a, [](double x) { return std::cos(x); }, 0);
}

Interval value_of(Function function, Interval a, Interval b) {
  const auto size = [&a] {
    const double largest = std::max(std::fabs(a.low), std::fabs(a.high));
    return Interval{a.contains(0) ? 0 : std::min(std::fabs(a.low), std::fabs(a.high)), largest};
  };
  switch (function) {
    case Function::kAtan2:
      return angle(a, b);
    case Function::kExp: {
      const Interval value = rising(a, [](double x) { return std::exp(x); });
      return {std::max(value.low, 0.0), value.high};
    }
    case Function::kLog:
      return a.high < 0 ? Interval::line()
                        : rising({std::max(a.low, 0.0), a.high}, [](double x) { return std::log(x); });
    case Function::kSinh:
      return rising(a, [](double x) { return std::sinh(x); });
    case Function::kCosh: {
      const Interval value = rising(size(), [](double x) { return std::cosh(x); });
      return {std::max(value.low, 1.0), value.high};
    }
    case Function::kTanh: {
      const Interval value = rising(a, [](double x) { return std::tanh(x); });
      return {std::max(value.low, -1.0), std::min(value.high, 1.0)};
    }
    case Function::kPower: {
      if (a.high < 0) return Interval::line();
      const double low = std::max(a.low, 0.0);
      const Interval value = around(
          {std::pow(low, b.low), std::pow(low, b.high), std::pow(a.high, b.low), std::pow(a.high, b.high)},
          kFunctionUnits);  // the logarithm is bilinear in b and log a
      return {std::max(value.low, 0.0), value.high};
    }
    case Function::kAbs:
      return size();
    case Function::kFloor:
      return {std::floor(a.low), std::floor(a.high)};
    case Function::kMin:
      return {std::min(a.low, b.low), std::min(a.high, b.high)};
    case Function::kMax:
      return {std::max(a.low, b.low), std::max(a.high, b.high)};
    case Function::kWhereNegative:
      return taken(a.low < 0, a.high < 0, b);
    case Function::kWhereNotNegative:
      return taken(a.high >= 0, a.low >= 0, b);
    case Function::kEntry:
      return entries(a, b);
    default:
      return Interval::line();
  }
}

}  // namespace jourdain::support
