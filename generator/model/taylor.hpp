// Numbers that carry their derivatives through Expression::evaluate.
#pragma once

#include <cmath>

namespace jourdain::model {

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

}  // namespace jourdain::model
