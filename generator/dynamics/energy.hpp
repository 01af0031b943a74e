// Kinetic and potential energy, and the inertia of rotors.
#pragma once

#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// ½ ∫ |Σ v_i|² dm with v_i the velocity field that link i adds, on its composite body: each link's own half square and
/// its product with the velocity of the parent. Rotors count with ½ (gear rate)² inertia.
Ex derive_kinetic_energy(const Scene& scene);

/// `energy` and that of the rotors.
Ex with_rotor_energy(const Scene& scene, Ex energy);

/// Of gravity (zero at the inertial origin), joint springs and force elements, J.
Ex derive_potential_energy(const Scene& scene);

/// gear_ratio² rotor_inertia
Ex reflected_inertia(const Scene& scene, const model::Actuator& actuator);

}  // namespace jourdain::dynamics
