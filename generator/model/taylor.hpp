// Numbers that carry their derivatives through Expression::evaluate.
#pragma once

#include <cmath>

namespace jourdain::model {

/// Value, first and second derivative with respect to one variable; rules of calculus operation by operation.
/// Scalar: any number that is made from a double; its sqrt, sin and cos are found by its namespace.
template <class Scalar>
struct Taylor {
  Scalar value = Scalar(0), first = Scalar(0), second = Scalar(0);

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
            a.second * b.value + Scalar(2) * a.first * b.first + a.value * b.second};
  }
  friend Taylor operator/(const Taylor& a, const Taylor& b) {
    const Scalar r = Scalar(1) / b.value;
    return a * b.chained(r, -r * r, Scalar(2) * r * r * r);
  }
  friend Taylor sqrt(const Taylor& a) {
    using std::sqrt;
    const Scalar root = sqrt(a.value);
    return a.chained(root, Scalar(1) / (Scalar(2) * root), Scalar(-1) / (Scalar(4) * root * a.value));
  }
  friend Taylor sin(const Taylor& a) {
    using std::cos, std::sin;
    return a.chained(sin(a.value), cos(a.value), -sin(a.value));
  }
  friend Taylor cos(const Taylor& a) {
    using std::cos, std::sin;
    return a.chained(cos(a.value), -sin(a.value), -cos(a.value));
  }
};

}  // namespace jourdain::model
