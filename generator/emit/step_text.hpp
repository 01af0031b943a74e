// Text of the emitted steps: what they share, and their bodies from templates.
#pragma once

#include <string>
#include <vector>

#include "emit/files.hpp"

namespace jourdain::emit {

/// Scene facts that decide what steps need.
struct StepScene {
  SceneShape shape;
  bool has_input = false;
  std::vector<std::size_t> quaternions;  ///< entry in y of each quaternion's w
};

/// What steps of kernels call: inputs at a stage, rates, unit length. Empty without steps.
std::string step_support(const StepScene& scene, const std::vector<FunctionInfo>& functions);

/// The struct of what multistep methods remember; empty where none is emitted.
std::string history_struct(const StepScene& scene, const std::vector<FunctionInfo>& functions);

/// Definitions of the step: with inputs also the one that takes a function of the state instead of them.
std::string step_definitions(const StepScene& scene, const FunctionInfo& function);

/// Operations of one step whose function forward_dynamics has `dynamics` and position_rate `rate` operations.
long step_operations(const SceneShape& shape, const Stepper& stepper, long dynamics, long rate);

}  // namespace jourdain::emit
