// States at which a mechanism with loops is validated.
#pragma once

#include <vector>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/configuration.hpp"

namespace jourdain::validate {

/// A state and a direction: displacements, velocities and accelerations count as those of the plan.
struct Ray {
  loops::Configuration configuration;
  std::vector<double> z, u, zdot;
  std::vector<double> displacement, velocity, input;
  double time = 0;
};

/// Rays from closed configurations of a seeded walk, with random velocities that the loops allow.
std::vector<Ray> draw_rays(const loops::NumericClosure& closure, const loops::LoopPlan& plan,
                           const model::Mechanism& mechanism, std::size_t count);

}  // namespace jourdain::validate
