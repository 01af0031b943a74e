// A quantity together with its first two derivatives with respect to time. Geometry written once on such numbers
// gives a constraint g, its rate ġ = G z + g_t and g̈ = G ż + γ, so that no derivative is written by hand.
#pragma once

#include <Eigen/Dense>

#include <cmath>

#include "support/elementary_functions.hpp"

namespace jourdain::reference::descriptor {

/// x(τ) = value + rate τ + ½ acceleration τ² + …, τ being time from now on; units of x, x/s, x/s². Operations follow
/// the rules of differentiation and are exact up to rounding.
template <class Scalar>
struct TimeJet {
  Scalar value = 0, rate = 0, acceleration = 0;

  TimeJet() = default;
  TimeJet(Scalar constant) : value(constant) {}  // NOLINT: numbers are quantities that do not change
  TimeJet(Scalar v, Scalar r, Scalar a) : value(v), rate(r), acceleration(a) {}

  friend TimeJet operator+(const TimeJet& a, const TimeJet& b) {
    return {a.value + b.value, a.rate + b.rate, a.acceleration + b.acceleration};
  }
  friend TimeJet operator-(const TimeJet& a, const TimeJet& b) {
    return {a.value - b.value, a.rate - b.rate, a.acceleration - b.acceleration};
  }
  friend TimeJet operator-(const TimeJet& a) { return {-a.value, -a.rate, -a.acceleration}; }
  friend TimeJet operator*(const TimeJet& a, const TimeJet& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate,
            a.acceleration * b.value + 2 * a.rate * b.rate + a.value * b.acceleration};
  }
  friend TimeJet operator/(const TimeJet& a, const TimeJet& b) {
    const Scalar ratio = a.value / b.value;
    const Scalar slope = (a.rate - ratio * b.rate) / b.value;
    return {ratio, slope, (a.acceleration - 2 * slope * b.rate - ratio * b.acceleration) / b.value};
  }
  TimeJet& operator+=(const TimeJet& other) { return *this = *this + other; }
  TimeJet& operator-=(const TimeJet& other) { return *this = *this - other; }
  TimeJet& operator*=(const TimeJet& other) { return *this = *this * other; }
  TimeJet& operator/=(const TimeJet& other) { return *this = *this / other; }

  friend TimeJet sin(const TimeJet& a) {
    using std::cos;
    using std::sin;
    const Scalar s = sin(a.value), c = cos(a.value);
    return {s, c * a.rate, c * a.acceleration - s * a.rate * a.rate};
  }
  friend TimeJet cos(const TimeJet& a) {
    using std::cos;
    using std::sin;
    const Scalar s = sin(a.value), c = cos(a.value);
    return {c, -s * a.rate, -s * a.acceleration - c * a.rate * a.rate};
  }
  friend TimeJet sqrt(const TimeJet& a) {
    using std::sqrt;
    const Scalar root = sqrt(a.value);
    const Scalar slope = a.rate / (2 * root);
    return {root, slope, (a.acceleration / 2 - slope * slope) / root};
  }
  /// Angle of the vector (x, y) in (−π, π], rad.
  friend TimeJet atan2(const TimeJet& y, const TimeJet& x) {
    using std::atan2;
    const Scalar square = x.value * x.value + y.value * y.value;
    const Scalar square_rate = 2 * (x.value * x.rate + y.value * y.rate);
    const Scalar slope = (x.value * y.rate - y.value * x.rate) / square;
    const Scalar moment = x.value * y.acceleration - y.value * x.acceleration;
    return {atan2(y.value, x.value), slope, (moment - slope * square_rate) / square};
  }
  friend TimeJet exp(const TimeJet& a) {
    using std::exp;
    const Scalar power = exp(a.value);
    return {power, power * a.rate, power * (a.acceleration + a.rate * a.rate)};
  }
  friend TimeJet log(const TimeJet& a) {
    using std::log;
    const Scalar slope = a.rate / a.value;
    return {log(a.value), slope, a.acceleration / a.value - slope * slope};
  }
  friend TimeJet sinh(const TimeJet& a) {
    using std::cosh, std::sinh;
    const Scalar s = sinh(a.value), c = cosh(a.value);
    return {s, c * a.rate, c * a.acceleration + s * a.rate * a.rate};
  }
  friend TimeJet cosh(const TimeJet& a) {
    using std::cosh, std::sinh;
    const Scalar s = sinh(a.value), c = cosh(a.value);
    return {c, s * a.rate, s * a.acceleration + c * a.rate * a.rate};
  }
  friend TimeJet tanh(const TimeJet& a) { return sinh(a) / cosh(a); }
  friend TimeJet pow(const TimeJet& a, const TimeJet& b) {
    using std::pow;
    if (b.rate != 0 || b.acceleration != 0) return exp(b * log(a));
    const Scalar slope = b.value * pow(a.value, b.value - 1);
    return {pow(a.value, b.value), slope * a.rate,
            slope * a.acceleration + b.value * (b.value - 1) * pow(a.value, b.value - 2) * a.rate * a.rate};
  }
  friend TimeJet fabs(const TimeJet& a) { return a.value < 0 ? -a : a; }
  friend TimeJet floor(const TimeJet& a) {
    using std::floor;
    return floor(a.value);
  }
  friend bool operator<(const TimeJet& a, const TimeJet& b) { return a.value < b.value; }
  bool operator==(const TimeJet&) const = default;
};

}  // namespace jourdain::reference::descriptor

/// Lets Eigen's fixed-size products, cross and dot products work on TimeJet.
template <class Scalar>
struct Eigen::NumTraits<jourdain::reference::descriptor::TimeJet<Scalar>>
    : Eigen::GenericNumTraits<jourdain::reference::descriptor::TimeJet<Scalar>> {
  using Jet = jourdain::reference::descriptor::TimeJet<Scalar>;
  using Real = Jet;
  using NonInteger = Jet;
  using Nested = Jet;
  using Literal = Jet;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 3,
    AddCost = 3,
    MulCost = 9
  };
};
