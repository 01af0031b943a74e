// Steps, and the functions that they share.
#pragma once

#include <vector>

#include "emit/tree.hpp"
#include "ir/module.hpp"
#include "programs/functions.hpp"

namespace jourdain::emit {

/// What only emitted functions use.
struct Support {
  std::vector<Struct> structs;
  std::vector<Table> tables;
  std::vector<Function> functions;
};

/// What steps call: rates, unit length, and what implicit_step.hpp says. Empty without steps.
Support step_support(const programs::SceneFacts& scene, const std::vector<programs::FunctionInfo>& functions,
                     const ir::Module& module);

/// Of the function that steps call at their stages.
inline constexpr const char* kAccelerations = "accelerations";

Function step_function(const programs::SceneFacts& scene, const programs::FunctionInfo& function);

/// Structs of what methods remember; empty where none is emitted.
std::vector<Struct> memory_structs(const programs::SceneFacts& scene,
                                   const std::vector<programs::FunctionInfo>& functions);

}  // namespace jourdain::emit
