// What of a scene depends on time explicitly, at given y, z and u. The one place that decides it.
#pragma once

#include "model/mechanism.hpp"

namespace jourdain::model {

struct TimeDependence {
  bool positions = false;  ///< a prescribed coordinate or a loop moves with t: M(y, t), dependent positions
  bool drift = false;  ///< positions move at z = 0: with t, or by states that prescribed coordinates follow
  bool dynamics = false;  ///< M, k̄ or q̄: positions, or an applied force
  bool outputs = false;   ///< some output at given y, z, u

  bool any() const { return dynamics || outputs; }  // positions are part of dynamics
};

/// True only where t stands in the description and reaches the quantity; never false where the value changes with t.
TimeDependence time_dependence(const Mechanism& mechanism);

}  // namespace jourdain::model
