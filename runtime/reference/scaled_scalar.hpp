// Lets Eigen work on numbers that know their rounding.
#pragma once

#include <Eigen/Core>

#include "support/scaled_real.hpp"

namespace jourdain::support {

inline const ScaledReal& conj(const ScaledReal& a) { return a; }
inline const ScaledReal& real(const ScaledReal& a) { return a; }
inline ScaledReal imag(const ScaledReal&) { return {}; }
inline ScaledReal abs2(const ScaledReal& a) { return a * a; }

}  // namespace jourdain::support

template <>
struct Eigen::NumTraits<jourdain::support::ScaledReal>
    : Eigen::GenericNumTraits<jourdain::support::ScaledReal> {
  using Real = jourdain::support::ScaledReal;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 4,
    AddCost = 100,
    MulCost = 200
  };
  static Real epsilon() { return Real(1e-75); }
  static Real dummy_precision() { return Real(1e-70); }
  static Real highest() { return Real(1e300); }
  static Real lowest() { return Real(-1e300); }
  static int digits10() { return 75; }
};
