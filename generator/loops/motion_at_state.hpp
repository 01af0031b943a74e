// What the programs of a mechanism with loops should compute at one state, from the symbolic equations and closures in 60 digits.
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "loops/derivative_check.hpp"
#include "loops/plan.hpp"

namespace jourdain::loops {

/// What the programs should compute at one state.
struct MotionAtState {
  Matrix M, B;  ///< of the tree; of the independent velocities
  Vector k, q, z, beta;
  Matrix G;
  Vector g, rate, gamma;
  Vector load;  ///< |M| |β| + |k̄| + |q̄|
  long double condition = 1;
  double kinetic_energy = 0, potential_energy = 0;
};

/// `closures` need hold no more than the closures of the mechanism.
MotionAtState motion_at_state(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                              const dynamics::Equations& closures, const LoopPlan& plan, const Ray& ray);

/// Of a leaf of the equations at the ray's state with velocities `z`; accelerations and multipliers are 0.
double leaf_value(const std::vector<double>& parameters, const Ray& ray, kinematics::LeafKind kind,
                  std::size_t i, const Vector& z);

}  // namespace jourdain::loops
