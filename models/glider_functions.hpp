// What glider.toml calls in compiled code, as its user writes it: here the polynomials that the description has, too.
#pragma once

#include "glider.hpp"

template <class Real>
struct glider::Functions {
  /// Lift at incidence 0, its slope and how a stall bends it; drag at incidence 0 and its growth. 1 and rad.
  Real at_zero = Real(0.25), slope = Real(4.8), stall = Real(30), parasitic = Real(0.02), induced = Real(1.1);

  JOURDAIN_FUNCTION Real lift(const Real& a) const noexcept {
    return at_zero + slope * a - stall * a * a * a;
  }
  JOURDAIN_FUNCTION Real drag(const Real& a) const noexcept { return parasitic + induced * a * a; }

  /// Slopes, for Jacobians and implicit steps.
  JOURDAIN_FUNCTION Real lift_incidence(const Real& a) const noexcept {
    return slope - Real(3) * stall * a * a;
  }
  JOURDAIN_FUNCTION Real drag_incidence(const Real& a) const noexcept { return Real(2) * induced * a; }
};
