// Everything applied but gravity: joint springs, dampers and friction, inputs, springs between frames, loads.
#pragma once

#include <vector>

#include "dynamics/points.hpp"

namespace jourdain::dynamics {

/// kZero: as if all inputs were zero.
enum class Inputs { kGiven, kZero };

/// Wrench of a load or a spring's end on a body: about the origin of the body's link, in W (the inertial frame for a body
/// that is fixed to it).
struct BodyWrench {
  model::BodyIndex body;
  Wrench wrench;
};

struct AppliedForces {
  std::vector<Wrench> on_link;         ///< of loads, about the link's origin, in W
  std::vector<std::vector<Ex>> along;  ///< of all others, per link and column; positive pushes forward
  std::vector<BodyWrench> on_bodies;   ///< loads and springs between frames, body by body
};

AppliedForces derive_applied_forces(Scene& scene, Inputs inputs);

/// Energy of joint springs and of springs between frames, J.
Ex derive_spring_energy(Scene& scene);

/// Value of an expression over time, coordinates, velocities, inputs and frames.
Ex general_value(Scene& scene, const std::string& name, const model::Expression& expression, Inputs inputs);

}  // namespace jourdain::dynamics
