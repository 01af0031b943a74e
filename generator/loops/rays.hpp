// States at which a mechanism with loops is validated.
#pragma once

#include <vector>

#include "loops/configuration.hpp"
#include "loops/plan.hpp"

namespace jourdain::loops {

/// A state and a direction: displacements, velocities and accelerations count as those of the plan.
struct Ray {
  Configuration configuration;
  std::vector<double> z, u, zdot;
  std::vector<double> displacement, velocity, input;
  double time = 0;
};

/// Rays from closed configurations of a seeded walk, with random velocities that the loops allow.
std::vector<Ray> draw_rays(const NumericClosure& closure, const LoopPlan& plan,
                           const model::Mechanism& mechanism, std::size_t count);

}  // namespace jourdain::loops
