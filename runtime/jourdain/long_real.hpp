// SPDX-License-Identifier: MIT
// A number of at least 50 decimal digits for emitted code, by CLN: include NAME_kernels.hpp and use
// NAME::Model<jourdain::LongReal>. Link with -lcln.
//
// A literal keeps its double value. What has no value (a root or a logarithm of a negative number, a division by
// zero, a double that is not finite) is not a number, and so is what follows from it. CLN's numbers are no use where
// results overflow: it throws, and emitted functions are noexcept. Not for use by two threads at once.
#pragma once

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/lfloat.h>
#include <cln/real.h>

#include <cmath>

namespace jourdain {

class LongReal {
 public:
  LongReal() : value_(zero()) {}
  explicit LongReal(double value)
      : value_(std::isfinite(value) ? of(value) : zero()), exists_(std::isfinite(value)) {}
  explicit LongReal(const cln::cl_LF& value) : value_(value) {}

  bool is_number() const { return exists_; }
  explicit operator double() const { return exists_ ? cln::double_approx(value_) : NAN; }

  /// The number as a sum of `count` doubles, each the rounding of what the earlier ones leave; 4 hold all digits.
  void split(double* parts, int count) const {
    cln::cl_LF rest = value_;
    for (int i = 0; i < count; ++i) {
      parts[i] = exists_ ? cln::double_approx(rest) : NAN;
      if (exists_ && i + 1 < count) rest = rest - of(parts[i]);
    }
  }

  /// The sum of `count` doubles.
  static LongReal joined(const double* parts, int count) {
    LongReal sum(parts[0]);
    for (int i = 1; i < count; ++i)
      if (parts[i] != 0) sum = sum + LongReal(parts[i]);
    return sum;
  }

  friend LongReal operator+(const LongReal& a, const LongReal& b) { return made(a.value_ + b.value_, a, b); }
  friend LongReal operator-(const LongReal& a, const LongReal& b) { return made(a.value_ - b.value_, a, b); }
  friend LongReal operator*(const LongReal& a, const LongReal& b) { return made(a.value_ * b.value_, a, b); }
  friend LongReal operator/(const LongReal& a, const LongReal& b) {
    return cln::zerop(b.value_) ? nothing() : made(a.value_ / b.value_, a, b);
  }
  friend LongReal operator-(const LongReal& a) { return made(-a.value_, a, a); }
  friend bool operator<(const LongReal& a, const LongReal& b) {
    return a.exists_ && b.exists_ && a.value_ < b.value_;
  }
  friend bool operator==(const LongReal& a, const LongReal& b) {
    return a.exists_ && b.exists_ && a.value_ == b.value_;
  }

  friend LongReal sqrt(const LongReal& a) {
    return cln::minusp(a.value_) ? nothing() : made(cln::sqrt(a.value_), a, a);
  }
  /// Emitted code asks for the sine and the cosine of an angle one after the other: CLN has both at the price of one.
  friend LongReal sin(const LongReal& a) { return rounded(both(a.value_).sin, a, a); }
  friend LongReal cos(const LongReal& a) { return rounded(both(a.value_).cos, a, a); }
  /// The angle of (x, y), in (−π, π]; 0 for (0, 0).
  friend LongReal atan2(const LongReal& y, const LongReal& x) {
    if (cln::zerop(x.value_) && cln::zerop(y.value_)) return made(zero(), y, x);
    return rounded(cln::atan(x.value_, y.value_), y, x);
  }
  friend LongReal exp(const LongReal& a) { return rounded(cln::exp(a.value_), a, a); }
  friend LongReal log(const LongReal& a) {
    return cln::plusp(a.value_) ? rounded(cln::ln(a.value_), a, a) : nothing();
  }
  friend LongReal sinh(const LongReal& a) { return rounded(cln::sinh(a.value_), a, a); }
  friend LongReal cosh(const LongReal& a) { return rounded(cln::cosh(a.value_), a, a); }
  friend LongReal tanh(const LongReal& a) { return rounded(cln::tanh(a.value_), a, a); }
  /// Of a negative number where b is a whole number.
  friend LongReal pow(const LongReal& a, const LongReal& b) {
    if (cln::zerop(b.value_)) return made(of(1), a, b);
    if (cln::zerop(a.value_)) return cln::plusp(b.value_) ? made(zero(), a, b) : nothing();
    LongReal power = exp(b * log(fabs(a)));
    if (!cln::minusp(a.value_)) return power;
    const cln::cl_I whole = cln::floor1(b.value_);
    if (!(b.value_ == cln::cl_float(whole, format()))) return nothing();
    return cln::oddp(whole) ? -power : power;
  }
  friend LongReal fabs(const LongReal& a) { return cln::minusp(a.value_) ? -a : a; }
  friend LongReal floor(const LongReal& a) {
    return rounded(cln::cl_R(cln::cl_I(cln::floor1(a.value_))), a, a);
  }

 private:
  static cln::float_format_t format() {
    static const cln::float_format_t fifty = cln::float_format(50);
    return fifty;
  }
  static cln::cl_LF to_long(const cln::cl_F& value) {
    using namespace cln;
    return As(cl_LF)(value);
  }
  static cln::cl_LF of(double value) { return to_long(cln::cl_float(value, format())); }
  static const cln::cl_LF& zero() {
    static const cln::cl_LF value = of(0);
    return value;
  }
  static const cln::cos_sin_t& both(const cln::cl_LF& angle) {
    static cln::cl_LF last = of(0);
    static cln::cos_sin_t values = cln::cos_sin(last);
    if (!(angle == last)) {
      values = cln::cos_sin(angle);
      last = angle;
    }
    return values;
  }
  static LongReal nothing() {
    LongReal result;
    result.exists_ = false;
    return result;
  }
  /// What follows from a and b.
  static LongReal made(const cln::cl_LF& value, const LongReal& a, const LongReal& b) {
    LongReal result(value);
    result.exists_ = a.exists_ && b.exists_;
    return result;
  }
  /// Functions of numbers near zero may come as exact numbers.
  static LongReal rounded(const cln::cl_R& value, const LongReal& a, const LongReal& b) {
    return made(to_long(cln::cl_float(value, format())), a, b);
  }

  cln::cl_LF value_;
  bool exists_ = true;
};

}  // namespace jourdain
