// States at which a mechanism with loops is validated, and its emitted derivatives there against differences of the emitted functions along the constraints.
#pragma once

#include <string>
#include <vector>

#include "ir/module.hpp"
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

/// How far a program of derivatives is from central differences of order 6, in long double, of forward_dynamics, residual and outputs
/// along the ray, norm over norm of its terms. `values` are the program's, in double. Zero for programs without derivatives, and of
/// functions that the module does not have.
double derivative_error(const NumericClosure& closure, const LoopPlan& plan, const ir::Module& module,
                        const std::vector<double>& parameters, const Ray& ray, const ir::Program& program,
                        const std::vector<double>& values);

}  // namespace jourdain::loops
