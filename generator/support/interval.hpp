// Sets of real numbers between two ends: what holds of all numbers in them at once.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

#include "support/elementary_functions.hpp"

namespace jourdain::support {

/// All real numbers from `low` to `high`; the ends may be infinite.
struct Interval {
  double low = 0, high = 0;

  /// One number.
  static Interval point(double value) { return {value, value}; }
  static constexpr Interval line() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  bool contains(double value) const { return low <= value && value <= high; }
  double width() const { return high - low; }
  double middle() const { return low + width() / 2; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// The next double towards −∞, as of std::nextafter, which is a call: half of what a proof by boxes would take.
inline double next_below(double x) {
  if (x == 0) return -std::numeric_limits<double>::denorm_min();
  if (!(x > -std::numeric_limits<double>::infinity())) return x;
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
  Interval result{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  bool is_number = true;
  for (const double value : values) {
    is_number = is_number && value == value;
    result.low = std::min(result.low, value);
    result.high = std::max(result.high, value);
  }
  if (!is_number) return Interval::line();
  return {below(result.low, units), above(result.high, units)};
}

// Enclosures, rounded outward: of any reals in the operands the exact result is inside, where it exists. Sines and
// cosines of the C library are taken to be within 4 units of the last place.

inline Interval operator-(Interval a) { return {-a.high, -a.low}; }

inline Interval operator+(Interval a, Interval b) {
  const double low = a.low + b.low, high = a.high + b.high;
  return std::isnan(low) || std::isnan(high) ? Interval::line() : Interval{below(low), above(high)};
}

inline Interval operator-(Interval a, Interval b) { return a + (-b); }

inline Interval operator*(Interval a, Interval b) {
  return around({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}

inline Interval operator/(Interval a, Interval b) {
  if (b.contains(0)) return Interval::line();
  return around({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
}

inline Interval square(Interval a) {
  const Interval ends = around({a.low * a.low, a.high * a.high});
  return {a.contains(0) ? 0 : std::max(0.0, ends.low), ends.high};
}

Interval sqrt(Interval a);
Interval sin(Interval a);
Interval cos(Interval a);
/// The line of functions of users.
Interval value_of(Function function, Interval a, Interval b);

}  // namespace jourdain::support
