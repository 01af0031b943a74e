#include "support/scaled_real.hpp"

#include <cln/cln.h>

#include <algorithm>
#include <limits>

namespace jourdain::support {

namespace {

cln::float_format_t format() {
  static const cln::float_format_t digits = cln::float_format(77);
  return digits;
}

cln::cl_LF to_long(const cln::cl_R& value) {
  using namespace cln;
  return As(cl_LF)(cl_float(value, format()));
}

/// |value|, to a few digits; long double has the range of all that models hold.
long double size_of(const cln::cl_LF& value) {
  if (cln::zerop(value)) return 0;
  const auto exponent = static_cast<long>(cln::float_exponent(value));
  constexpr long kSafe = 1000;  // CLN's doubles are neither denormal nor infinite
  if (std::labs(exponent) < kSafe) return std::fabs(static_cast<long double>(cln::double_approx(value)));
  if (std::labs(exponent) > 16000) return exponent > 0 ? INFINITY : 0;
  const cln::cl_LF fraction = cln::scale_float(value, -exponent);
  return std::ldexp(std::fabs(static_cast<long double>(cln::double_approx(fraction))), int(exponent));
}

}  // namespace

cln::cl_R to_exact(double value) {
  if (value == 0) return 0;
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  return cln::rational(cln::cl_DF(fraction)) * cln::expt(cln::cl_RA(2), exponent);
}

double nearest_double(const cln::cl_R& value) {
  static const cln::cl_R smallest = cln::expt(cln::cl_RA(2), -1022),
                         beyond = cln::expt(cln::cl_I(2), 1024) - cln::expt(cln::cl_I(2), 970);
  if (cln::abs(value) >= beyond) return cln::minusp(value) ? -INFINITY : INFINITY;
  if (cln::abs(value) >= smallest) return cln::double_approx(value);
  constexpr int kShift = 200;
  const cln::cl_R shifted = value * cln::expt(cln::cl_I(2), kShift);
  return cln::abs(shifted) < smallest ? 0 : std::ldexp(cln::double_approx(shifted), -kShift);
}

std::array<double, 4> split(const cln::cl_R& value) {
  std::array<double, 4> parts{};
  cln::cl_R rest = value;
  for (double& part : parts) {
    if (cln::zerop(rest)) break;
    part = nearest_double(rest);
    if (part == 0 || !std::isfinite(part)) break;
    rest = rest - to_exact(part);
    if (&part == parts.data() && !cln::zerop(rest)) rest = to_long(rest);  // what remains needs no fractions
  }
  return parts;
}

cln::cl_R joined(double head, const std::array<double, 3>& tail) {
  cln::cl_R sum = to_exact(head);
  for (const double part : tail)
    if (part != 0) sum = sum + to_exact(part);
  return sum;
}

const cln::cl_LF& ScaledReal::zero() {
  static const cln::cl_LF value = to_long(0);
  return value;
}

ScaledReal::ScaledReal(double value) : value_(zero()), scale_(std::fabs(static_cast<long double>(value))) {
  if (value == 0) return;
  if (std::isfinite(value))
    value_ = to_long(to_exact(value));
  else
    scale_ = NAN;
}

ScaledReal::ScaledReal(const cln::cl_R& value) : value_(to_long(value)), scale_(size_of(value_)) {}

ScaledReal ScaledReal::not_a_number() { return {zero(), NAN}; }

ScaledReal::operator double() const { return is_number() ? nearest_double(value_) : NAN; }

ScaledReal::operator long double() const {
  if (!is_number()) return NAN;
  const double head = nearest_double(value_);
  return std::isfinite(head) ? head + static_cast<long double>(nearest_double(value_ - to_exact(head)))
                             : head;
}

ScaledReal operator+(const ScaledReal& a, const ScaledReal& b) {
  if (a.is_nothing()) return b;
  if (b.is_nothing()) return a;
  return {a.value_ + b.value_, std::isnan(a.scale_) ? a.scale_ : std::max(b.scale_, a.scale_)};
}

ScaledReal operator-(const ScaledReal& a, const ScaledReal& b) { return a + -b; }

ScaledReal operator*(const ScaledReal& a, const ScaledReal& b) {
  if (a.is_nothing() && std::isfinite(b.scale_)) return a;
  if (b.is_nothing() && std::isfinite(a.scale_)) return b;
  const long double by_a = a.scale_ * size_of(b.value_), by_b = b.scale_ * size_of(a.value_);
  if (a.is_number() && b.is_number() && (std::isnan(by_a) || std::isnan(by_b)))
    return {a.value_ * b.value_, INFINITY};  // what has no bounded effect, times zero
  return {a.value_ * b.value_, std::isnan(by_a) ? by_a : std::max(by_b, by_a)};
}

ScaledReal operator/(const ScaledReal& a, const ScaledReal& b) {
  if (cln::zerop(b.value_) || !b.is_number() || !a.is_number()) return ScaledReal::not_a_number();
  if (a.is_nothing()) return a;
  const cln::cl_LF ratio = a.value_ / b.value_;
  const long double size = size_of(b.value_);
  return {ratio, std::max(a.scale_ / size, size_of(ratio) * (b.scale_ / size))};
}

ScaledReal sqrt(const ScaledReal& a) {
  if (a.is_nothing()) return a;
  if (!a.is_number() || cln::minusp(a.value_)) return ScaledReal::not_a_number();
  const cln::cl_LF root = to_long(cln::sqrt(a.value_));
  return {root, std::max(size_of(root), a.scale_ / (2 * size_of(root)))};
}

ScaledReal sin(const ScaledReal& a) {
  if (a.is_nothing() || !a.is_number()) return a;
  const cln::cos_sin_t both = cln::cos_sin(a.value_);
  const cln::cl_LF sine = to_long(both.sin);
  return {sine, std::max(size_of(sine), a.scale_ * size_of(to_long(both.cos)))};
}

ScaledReal cos(const ScaledReal& a) {
  if (a.is_nothing()) return 1;
  if (!a.is_number()) return a;
  const cln::cos_sin_t both = cln::cos_sin(a.value_);
  const cln::cl_LF cosine = to_long(both.cos);
  return {cosine, std::max(size_of(cosine), a.scale_ * size_of(to_long(both.sin)))};
}

ScaledReal atan2(const ScaledReal& y, const ScaledReal& x) {
  if (!y.is_number() || !x.is_number()) return ScaledReal::not_a_number();
  if (cln::zerop(y.value_) && cln::zerop(x.value_)) return 0;
  const cln::cl_LF angle = to_long(cln::atan(x.value_, y.value_));
  const long double sy = size_of(y.value_), sx = size_of(x.value_), length = std::hypot(sx, sy);
  const long double turn = std::max(sx / length * (y.scale_ / length), sy / length * (x.scale_ / length));
  return {angle, std::max(size_of(angle), turn)};
}

namespace {

/// Beyond it powers of e are infinite, or nothing, in every type of number that a model may have.
constexpr long double kLargestExponent = 12000;

}  // namespace

ScaledReal exp(const ScaledReal& a) {
  if (!a.is_number()) return a;
  if (size_of(a.value_) > kLargestExponent)
    return cln::minusp(a.value_) ? ScaledReal(0) : ScaledReal::not_a_number();
  const cln::cl_LF value = to_long(cln::exp(a.value_));
  return {value, std::max(size_of(value), a.scale_ * size_of(value))};
}

ScaledReal log(const ScaledReal& a) {
  if (!a.is_number() || !cln::plusp(a.value_)) return ScaledReal::not_a_number();
  const cln::cl_LF value = to_long(cln::ln(a.value_));
  return {value, std::max(size_of(value), a.scale_ / size_of(a.value_))};
}

ScaledReal sinh(const ScaledReal& a) {
  if (a.is_nothing() || !a.is_number()) return a;
  if (size_of(a.value_) > kLargestExponent) return ScaledReal::not_a_number();
  const cln::cl_LF value = to_long(cln::sinh(a.value_));
  return {value, std::max(size_of(value), a.scale_ * size_of(to_long(cln::cosh(a.value_))))};
}

ScaledReal cosh(const ScaledReal& a) {
  if (!a.is_number()) return a;
  if (size_of(a.value_) > kLargestExponent) return ScaledReal::not_a_number();
  const cln::cl_LF value = to_long(cln::cosh(a.value_));
  return {value, std::max(size_of(value), a.scale_ * size_of(to_long(cln::sinh(a.value_))))};
}

ScaledReal tanh(const ScaledReal& a) {
  constexpr long double kSaturated = 200;  // 1 − tanh is 1e-173
  if (a.is_nothing() || !a.is_number()) return a;
  if (size_of(a.value_) > kSaturated) return cln::minusp(a.value_) ? -1 : 1;
  const cln::cl_LF value = to_long(cln::tanh(a.value_)), slope = to_long(1 - cln::square(value));
  return {value, std::max(size_of(value), a.scale_ * size_of(slope))};
}

ScaledReal pow(const ScaledReal& a, const ScaledReal& b) {
  if (!a.is_number() || !b.is_number()) return ScaledReal::not_a_number();
  if (cln::zerop(b.value_)) return 1;
  if (cln::zerop(a.value_)) return cln::plusp(b.value_) ? ScaledReal(0) : ScaledReal::not_a_number();
  const bool is_negative = cln::minusp(a.value_), is_whole = cln::zerop(b.value_ - cln::ffloor(b.value_));
  if (is_negative && !is_whole) return ScaledReal::not_a_number();
  const ScaledReal size = {cln::abs(a.value_), a.scale_}, power = exp(b * log(size));
  const bool is_odd = is_whole && cln::oddp(cln::floor1(b.value_));
  return is_negative && is_odd ? -power : power;
}

ScaledReal floor(const ScaledReal& a) {
  if (!a.is_number()) return a;
  return ScaledReal(cln::cl_R(cln::floor1(a.value_)));
}

}  // namespace jourdain::support
