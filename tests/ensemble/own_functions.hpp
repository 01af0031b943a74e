// Functions with data that a model's emitted code calls.
#pragma once

#include "glider_packs/glider_packs_kernels.hpp"

template <class Real>
struct glider_packs::Functions {
  Real slope = Real(4.8);

  Real lift(const Real& a) const noexcept { return Real(0.25) + slope * a - Real(30.0) * (a * a * a); }
  Real drag(const Real& a) const noexcept { return Real(0.02) + Real(1.1) * (a * a); }
};
