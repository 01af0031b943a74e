// SPDX-License-Identifier: MIT
// A number of at least 50 decimal digits for emitted code, by CLN: include NAME_kernels.hpp and use
// NAME::Model<jourdain::LongReal>. Link with -lcln.
//
// A literal keeps its double value. CLN's numbers are no use where results overflow, where a root of a negative number
// is taken or where a number is not finite: it throws, and emitted functions are noexcept. Not for use by two
// threads at once.
#pragma once

#include <cln/float.h>
#include <cln/lfloat.h>
#include <cln/real.h>

namespace jourdain {

class LongReal {
 public:
  LongReal() : value_(zero()) {}
  explicit LongReal(double value) : value_(of(value)) {}
  explicit LongReal(const cln::cl_LF& value) : value_(value) {}

  explicit operator double() const { return cln::double_approx(value_); }

  /// The number as a sum of `count` doubles, each the rounding of what the earlier ones leave; 4 hold all digits.
  void split(double* parts, int count) const {
    cln::cl_LF rest = value_;
    for (int i = 0; i < count; ++i) {
      parts[i] = cln::double_approx(rest);
      if (i + 1 < count) rest = rest - of(parts[i]);
    }
  }

  /// The sum of `count` doubles.
  static LongReal joined(const double* parts, int count) {
    cln::cl_LF sum = of(parts[0]);
    for (int i = 1; i < count; ++i)
      if (parts[i] != 0) sum = sum + of(parts[i]);
    return LongReal(sum);
  }

  friend LongReal operator+(const LongReal& a, const LongReal& b) { return LongReal(a.value_ + b.value_); }
  friend LongReal operator-(const LongReal& a, const LongReal& b) { return LongReal(a.value_ - b.value_); }
  friend LongReal operator*(const LongReal& a, const LongReal& b) { return LongReal(a.value_ * b.value_); }
  friend LongReal operator/(const LongReal& a, const LongReal& b) { return LongReal(a.value_ / b.value_); }
  friend LongReal operator-(const LongReal& a) { return LongReal(-a.value_); }
  friend bool operator<(const LongReal& a, const LongReal& b) { return a.value_ < b.value_; }

  friend LongReal sqrt(const LongReal& a) { return LongReal(cln::sqrt(a.value_)); }
  /// Emitted code asks for the sine and the cosine of an angle one after the other: CLN has both at the price of one.
  friend LongReal sin(const LongReal& a) { return long_float(both(a.value_).sin); }
  friend LongReal cos(const LongReal& a) { return long_float(both(a.value_).cos); }
  /// The angle of (x, y), in (−π, π]; 0 for (0, 0).
  friend LongReal atan2(const LongReal& y, const LongReal& x) {
    if (cln::zerop(x.value_) && cln::zerop(y.value_)) return LongReal();
    return long_float(cln::atan(x.value_, y.value_));
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
  /// Functions of numbers near zero may come as exact numbers.
  static LongReal long_float(const cln::cl_R& value) {
    return LongReal(to_long(cln::cl_float(value, format())));
  }

  cln::cl_LF value_;
};

}  // namespace jourdain
