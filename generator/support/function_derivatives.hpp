// Partial derivatives of the functions that have them everywhere, for numbers and symbols alike.
#pragma once

#include "support/check.hpp"
#include "support/elementary_functions.hpp"

namespace jourdain::support {

/// f, f′, f″ at one argument.
template <class Real>
struct Curve {
  Real value, slope, curvature;
};

/// Of a function of one argument without kinks. `one` is 1.
template <class Real>
Curve<Real> curve_of(Function function, const Real& a, const Real& one) {
  const Real value = value_of(function, a, a);
  switch (function) {
    case Function::kExp:
      return {value, value, value};
    case Function::kLog: {
      const Real slope = one / a;
      return {value, slope, -(slope * slope)};
    }
    case Function::kSinh:
      return {value, value_of(Function::kCosh, a, a), value};
    case Function::kCosh:
      return {value, value_of(Function::kSinh, a, a), value};
    case Function::kTanh: {
      const Real slope = one - value * value;
      return {value, slope, -((value + value) * slope)};
    }
    default:
      throw InternalError("no smooth function of one argument");
  }
}

/// a^b of a alone.
template <class Real>
Curve<Real> power_of(const Real& a, const Real& b, const Real& one) {
  const Real less = b - one;
  return {value_of(Function::kPower, a, b), b * value_of(Function::kPower, a, less),
          b * less * value_of(Function::kPower, a, less - one)};
}

/// f(a, b) and its partial derivatives.
template <class Real>
struct Surface {
  Real value, by_a, by_b, by_aa, by_ab, by_bb;
};

/// atan2; a power, a > 0; of calls that of what stands in for them, of numbers only.
template <class Real>
Surface<Real> surface_of(Function function, const Real& a, const Real& b, const Real& one) {
  const Real value = value_of(function, a, b);
  if (function == Function::kAtan2) {
    const Real square = a * a + b * b, p = a / square, q = b / square, twice = p * q + p * q;
    return {value, q, -p, -twice, p * p - q * q, twice};
  }
  if constexpr (requires { a < b; }) {
    const Real zero = one - one;
    if (function == Function::kArgument)
      return {value, one, number_in<Real>(kShareOfEarlierArguments), zero, zero, zero};
    if (function == Function::kCall)
      return {value, stand_in_of(a, b, 1), zero, stand_in_of(a, b, 2), zero, zero};
  }
  if (function != Function::kPower) throw InternalError("no smooth function of two arguments");
  const Curve<Real> of_a = power_of(a, b, one);
  const Real logarithm = value_of(Function::kLog, a, a), by_b = value * logarithm;
  return {value,
          of_a.slope,
          by_b,
          of_a.curvature,
          value_of(Function::kPower, a, b - one) * (one + b * logarithm),
          by_b * logarithm};
}

}  // namespace jourdain::support
