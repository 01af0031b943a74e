// Everything applied but gravity: joint springs, dampers and friction, and force elements.
#pragma once

#include "dynamics/element_forces.hpp"

namespace jourdain::dynamics {

AppliedForces derive_applied_forces(const Scene& scene, Inputs inputs);

/// Energy of joint springs and of force elements, J.
Ex derive_elastic_energy(const Scene& scene);

}  // namespace jourdain::dynamics
