// Numbers that carry more than a value through Expression::evaluate: derivatives, or a bound of what was added up.
#pragma once

#include <cmath>

namespace jourdain::reference {

/// Value, first and second derivative with respect to one variable; rules of calculus operation by operation.
template <class Scalar>
struct Taylor {
  Scalar value = 0, first = 0, second = 0;

  /// f(this), from f and its derivatives at the value.
  Taylor chained(Scalar f, Scalar df, Scalar ddf) const {
    return {f, df * first, ddf * first * first + df * second};
  }
  friend Taylor operator-(const Taylor& a) { return {-a.value, -a.first, -a.second}; }
  friend Taylor operator+(const Taylor& a, const Taylor& b) {
    return {a.value + b.value, a.first + b.first, a.second + b.second};
  }
  friend Taylor operator-(const Taylor& a, const Taylor& b) { return a + (-b); }
  friend Taylor operator*(const Taylor& a, const Taylor& b) {
    return {a.value * b.value, a.first * b.value + a.value * b.first,
            a.second * b.value + 2 * a.first * b.first + a.value * b.second};
  }
  friend Taylor operator/(const Taylor& a, const Taylor& b) {
    const Scalar r = 1 / b.value;
    return a * b.chained(r, -r * r, 2 * r * r * r);
  }
  friend Taylor sqrt(const Taylor& a) {
    const Scalar root = std::sqrt(a.value);
    return a.chained(root, 1 / (2 * root), -1 / (4 * root * a.value));
  }
  friend Taylor sin(const Taylor& a) {
    return a.chained(std::sin(a.value), std::cos(a.value), -std::sin(a.value));
  }
  friend Taylor cos(const Taylor& a) {
    return a.chained(std::cos(a.value), -std::sin(a.value), -std::cos(a.value));
  }
};

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
