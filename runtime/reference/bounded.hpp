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
  Bounded(Scalar v) : value(v), scale(std::fabs(v)) {}  // NOLINT: numbers are bounded numbers
  Bounded(Scalar v, Scalar s) : value(v), scale(s) {}

  friend Bounded operator-(const Bounded& a) { return {-a.value, a.scale}; }
  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    return {a.value + b.value, a.scale + b.scale};
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) {
    return {a.value - b.value, a.scale + b.scale};
  }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    return {a.value * b.value, std::fabs(a.value) * b.scale + a.scale * std::fabs(b.value)};
  }
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const Scalar size = std::fabs(b.value);
    return {a.value / b.value, a.scale / size + std::fabs(a.value) * b.scale / (size * size)};
  }
  friend Bounded sqrt(const Bounded& a) {
    const Scalar root = std::sqrt(a.value);
    return {root, root + (root > 0 ? a.scale / (2 * root) : 0)};
  }
  friend Bounded sin(const Bounded& a) { return {std::sin(a.value), std::fabs(std::sin(a.value)) + a.scale}; }
  friend Bounded cos(const Bounded& a) { return {std::cos(a.value), std::fabs(std::cos(a.value)) + a.scale}; }
};

}  // namespace jourdain::reference
