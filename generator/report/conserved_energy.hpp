// Whether a scene keeps its energy.
#pragma once

#include "model/mechanism.hpp"

namespace jourdain::report {

/// Whether kinetic and potential energy together stay constant: no damping, friction, prescribed motion,
/// constraints that move with time or ask for velocities, loads, laws without potential; inputs must be zero as well,
/// which the caller knows.
bool conserves_energy(const model::Mechanism& mechanism);

}  // namespace jourdain::report
