// What a step starts from and ends with, and the two ways to take it: by the text, and by the method's definition.
#pragma once

#include "readback/api.hpp"
#include "readback/interpreter.hpp"
#include "readback/opaque.hpp"

namespace jourdain::readback {

struct StepData {
  Motion motion;
  Exact h = exact(0.0);
  ExactVector input;                    ///< held over the step
  bool is_sampled = false;              ///< the input is a function of the state instead
  int count = 0;                        ///< of RateHistory or Accelerations
  std::vector<ExactVector> ydot, zdot;  ///< of RateHistory, newest first
  ExactVector accelerations;
};

/// Operations that the text itself executed and the largest number on the way.
struct StepExecution {
  std::size_t operations = 0;
  double largest = 1;
};

/// Executes the step of the text. Throws Refusal.
StepExecution step_by_text(const Unit& unit, const Expected& expected, const FunctionApi& api,
                           OpaqueSystem& system, StepData& data);

/// The method as it is defined: explicit ones by their tableau, linearly implicit ones as Rosenbrock methods
/// for the system x' = rate(x, z), z' = a, 0 = r(x, z, a, t) of index 1 in displacements x, velocities and
/// accelerations. Throws Refusal.
void step_by_definition(const Expected& expected, const std::string& method, OpaqueSystem& system,
                        StepData& data);

/// The part of that for linearly implicit methods.
void rosenbrock_step(const Expected& expected, const RosenbrockTable& table, OpaqueSystem& system,
                     StepData& data);

/// Calls `system.correct` as often as a step ends with it, and brings quaternions to unit length before.
void normalise_quaternions(const Expected& expected, Motion& motion);
ExactVector input_at(OpaqueSystem& system, const StepData& data, const Motion& motion);

}  // namespace jourdain::readback
