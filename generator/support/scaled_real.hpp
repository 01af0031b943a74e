// A real number of 77 digits that knows how far rounding on the way to it may have moved it: what tells wrong
// algebra from rounding, whatever the units and however much cancels.
#pragma once

#include <cln/lfloat.h>
#include <cln/real.h>

#include <array>
#include <cmath>

namespace jourdain::support {

/// A value with the largest first-order effect on it of a relative change by 1 in any single number that it
/// was computed from. Two ways to compute one thing agree to a small multiple of the unit roundoff times the
/// larger scale. Where something has no value (a division by zero, a root of a negative number) it is not a
/// number, and so is what follows.
class ScaledReal {
 public:
  ScaledReal() : value_(zero()) {}
  ScaledReal(double value);                                          // NOLINT: doubles are exact
  ScaledReal(int value) : ScaledReal(static_cast<double>(value)) {}  // NOLINT
  /// Rounded to 77 digits.
  explicit ScaledReal(const cln::cl_R& value);
  static ScaledReal not_a_number();

  const cln::cl_LF& value() const { return value_; }
  /// Infinite where a change would have no bounded effect.
  long double scale() const { return scale_; }
  /// The same value, given.
  ScaledReal forgetting() const { return is_number() ? ScaledReal(cln::cl_R(value_)) : *this; }
  /// The same value with this scale, unless its own is larger.
  ScaledReal with_scale(long double scale) const { return {value_, scale > scale_ ? scale : scale_}; }
  bool is_number() const { return !std::isnan(scale_); }
  explicit operator double() const;
  explicit operator long double() const;

  friend ScaledReal operator-(const ScaledReal& a) { return {-a.value_, a.scale_}; }
  friend ScaledReal operator+(const ScaledReal& a, const ScaledReal& b);
  friend ScaledReal operator-(const ScaledReal& a, const ScaledReal& b);
  friend ScaledReal operator*(const ScaledReal& a, const ScaledReal& b);
  friend ScaledReal operator/(const ScaledReal& a, const ScaledReal& b);
  ScaledReal& operator+=(const ScaledReal& b) { return *this = *this + b; }
  ScaledReal& operator-=(const ScaledReal& b) { return *this = *this - b; }
  ScaledReal& operator*=(const ScaledReal& b) { return *this = *this * b; }
  ScaledReal& operator/=(const ScaledReal& b) { return *this = *this / b; }

  friend ScaledReal sqrt(const ScaledReal& a);
  friend ScaledReal sin(const ScaledReal& a);
  friend ScaledReal cos(const ScaledReal& a);
  friend ScaledReal atan2(const ScaledReal& y, const ScaledReal& x);
  friend ScaledReal exp(const ScaledReal& a);
  friend ScaledReal log(const ScaledReal& a);
  friend ScaledReal sinh(const ScaledReal& a);
  friend ScaledReal cosh(const ScaledReal& a);
  friend ScaledReal tanh(const ScaledReal& a);
  friend ScaledReal pow(const ScaledReal& a, const ScaledReal& b);
  friend ScaledReal floor(const ScaledReal& a);
  friend ScaledReal abs(const ScaledReal& a) { return {cln::abs(a.value_), a.scale_}; }
  friend ScaledReal fabs(const ScaledReal& a) { return abs(a); }
  friend bool isfinite(const ScaledReal& a) { return std::isfinite(a.scale_); }

  friend bool operator==(const ScaledReal& a, const ScaledReal& b) {
    return a.is_number() && b.is_number() && a.value_ == b.value_;
  }
  friend bool operator!=(const ScaledReal& a, const ScaledReal& b) { return !(a == b); }
  friend bool operator<(const ScaledReal& a, const ScaledReal& b) {
    return a.is_number() && b.is_number() && a.value_ < b.value_;
  }
  friend bool operator>(const ScaledReal& a, const ScaledReal& b) { return b < a; }
  friend bool operator<=(const ScaledReal& a, const ScaledReal& b) {
    return a.is_number() && b.is_number() && a.value_ <= b.value_;
  }
  friend bool operator>=(const ScaledReal& a, const ScaledReal& b) { return b <= a; }

 private:
  ScaledReal(const cln::cl_LF& value, long double scale) : value_(value), scale_(scale) {}
  static const cln::cl_LF& zero();
  bool is_nothing() const { return scale_ == 0; }  ///< zero by itself, not by cancellation

  cln::cl_LF value_;
  long double scale_ = 0;
};

/// A finite double as a number of CLN, which knows no denormal doubles by itself.
cln::cl_R to_exact(double value);

/// The nearest double; infinite beyond the largest one.
double nearest_double(const cln::cl_R& value);

/// A number as an unevaluated sum of doubles, each the nearest one to what the earlier ones leave: 63 digits.
std::array<double, 4> split(const cln::cl_R& value);
cln::cl_R joined(double head, const std::array<double, 3>& tail);

}  // namespace jourdain::support
