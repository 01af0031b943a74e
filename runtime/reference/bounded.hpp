// Numbers that carry a bound of what was added up through Expression::evaluate.
#pragma once

#include <cmath>

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

 private:
  static Scalar size(const Scalar& v) {
    using std::fabs;
    return fabs(v);
  }
};

}  // namespace jourdain::reference
