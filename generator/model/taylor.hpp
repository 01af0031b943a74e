// Numbers that carry their derivatives through Expression::evaluate.
#pragma once

#include <cmath>

#include "support/function_derivatives.hpp"

namespace jourdain::model {

/// Value, first and second derivative with respect to one variable; rules of calculus operation by operation.
/// Scalar: any number that is made from a double; its functions are found by its namespace. At a kink of a function the
/// derivatives are those of the side that the value is taken from.
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
  friend Taylor fabs(const Taylor& a) { return a.value < Scalar(0) ? -a : a; }
  friend Taylor floor(const Taylor& a) {
    using std::floor;
    return {floor(a.value)};
  }
  friend bool operator<(const Taylor& a, const Taylor& b) { return a.value < b.value; }
  friend Taylor value_of(support::Function function, const Taylor& a, const Taylor& b) {
    using support::Function;
    const auto one = Scalar(1);
    const support::FunctionFacts& facts = support::facts_of(function);
    if (facts.has_kinks) return support::value_with_kinks(function, a, b);
    const bool is_curve = facts.operands == 1 ||
                          (function == Function::kPower && b.first == Scalar(0) && b.second == Scalar(0));
    if (is_curve) {
      const support::Curve<Scalar> f = facts.operands == 1 ? support::curve_of(function, a.value, one)
                                                           : support::power_of(a.value, b.value, one);
      return a.chained(f.value, f.slope, f.curvature);
    }
    const support::Surface<Scalar> f = support::surface_of(function, a.value, b.value, one);
    return {f.value, f.by_a * a.first + f.by_b * b.first,
            f.by_aa * a.first * a.first + Scalar(2) * f.by_ab * a.first * b.first +
                f.by_bb * b.first * b.first + f.by_a * a.second + f.by_b * b.second};
  }
};

}  // namespace jourdain::model
