// Text of the emitted steps: what they share, and their bodies from templates.
#pragma once

#include <string>
#include <vector>

#include "ir/module.hpp"
#include "model/coordinates.hpp"
#include "programs/functions.hpp"

namespace jourdain::emit {

/// What steps of kernels call: inputs at a stage, rates, unit length. Empty without steps.
std::string step_support(const programs::SceneFacts& scene,
                         const std::vector<programs::FunctionInfo>& functions, const ir::Module& module);

/// The structs of what methods remember; empty where none is emitted.
std::string history_struct(const programs::SceneFacts& scene,
                           const std::vector<programs::FunctionInfo>& functions);

/// Definitions of the step: with inputs also the one that takes a function of the state instead of them.
std::string step_definitions(const programs::SceneFacts& scene, const programs::FunctionInfo& function);

/// Operations of one step, with the functions that it calls.
long step_operations(const programs::SceneFacts& scene, const programs::Stepper& stepper,
                     const ir::Module& module);

}  // namespace jourdain::emit
