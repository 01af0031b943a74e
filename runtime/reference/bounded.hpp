// Numbers that carry a bound of what was added up through Expression::evaluate.
#pragma once

#include <algorithm>
#include <cmath>

#include "support/elementary_functions.hpp"

namespace jourdain::reference {

/// A value with a bound `scale` ≥ |value| of what it was added up from: rounding moves the value by a small multiple of
/// the scale times the unit roundoff.
template <class Scalar>
struct Bounded {
  Scalar value = 0, scale = 0;

  Bounded() = default;
  Bounded(Scalar v) : value(v), scale(size(v)) {}  // NOLINT: numbers are bounded numbers
  Bounded(Scalar v, Scalar s) : value(v), scale(s) {}

  friend Bounded operator-(const Bounded& a) { return {-a.value, a.scale}; }
  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    return {a.value + b.value, a.scale + b.scale};
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) {
    return {a.value - b.value, a.scale + b.scale};
  }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    return {a.value * b.value, size(a.value) * b.scale + a.scale * size(b.value)};
  }
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const Scalar divisor = size(b.value);
    return {a.value / b.value, a.scale / divisor + size(a.value) * b.scale / (divisor * divisor)};
  }
  friend Bounded sqrt(const Bounded& a) {
    using std::sqrt;
    const Scalar root = sqrt(a.value);
    return {root, root + (root > Scalar(0) ? a.scale / (Scalar(2) * root) : Scalar(0))};
  }
  friend Bounded sin(const Bounded& a) {
    using std::sin;
    const Scalar sine = sin(a.value);
    return {sine, size(sine) + a.scale};
  }
  friend Bounded cos(const Bounded& a) {
    using std::cos;
    const Scalar cosine = cos(a.value);
    return {cosine, size(cosine) + a.scale};
  }
  /// A relative change of a by 1 moves a smooth function by its slope times a's scale.
  friend Bounded value_of(support::Function function, const Bounded& a, const Bounded& b) {
    using std::cosh, std::exp, std::log, std::sinh;
    using support::Function, support::value_of;
    const Scalar result = value_of(function, a.value, b.value), one = Scalar(1);
    auto moved = Scalar(0);
    switch (function) {
      case Function::kAtan2: {
        const Scalar square = a.value * a.value + b.value * b.value;
        if (square > Scalar(0)) moved = (size(b.value) * a.scale + size(a.value) * b.scale) / square;
        break;
      }
      case Function::kExp:
        moved = result * a.scale;
        break;
      case Function::kLog:
        moved = a.scale / a.value;
        break;
      case Function::kSinh:
        moved = cosh(a.value) * a.scale;
        break;
      case Function::kCosh:
        moved = size(sinh(a.value)) * a.scale;
        break;
      case Function::kTanh:
        moved = (one - result * result) * a.scale;
        break;
      case Function::kPower:
        if (size(a.value) > Scalar(0))
          moved =
              size(result) * (size(b.value) * a.scale / size(a.value) + b.scale * size(log(size(a.value))));
        break;
      case Function::kAbs:
      case Function::kFloor:
        moved = a.scale;
        break;
      case Function::kMin:
      case Function::kMax:
        moved = std::max(a.scale, b.scale);
        break;
      case Function::kEntry:
        break;
      case Function::kArgument:
        moved = a.scale + b.scale;
        break;
      case Function::kCall:
        moved = a.scale;
        break;
      case Function::kWhereNegative:
      case Function::kWhereNotNegative:
        return {result,
                (a.value < Scalar(0)) == (function == Function::kWhereNegative) ? b.scale : Scalar(0)};
    }
    return {result, size(result) + moved};
  }

 private:
  static Scalar size(const Scalar& v) {
    using std::fabs;
    return fabs(v);
  }
};

}  // namespace jourdain::reference
