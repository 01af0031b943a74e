// Which functions an emitted model may have, beside its steps.
#pragma once

#include <optional>
#include <string_view>

namespace jourdain::ir {

/// A program of a module whose name is `name_of` computes this function. Steps call them and have no program.
enum class FunctionId {
  kInitialState,
  kPositionRate,
  kMassMatrix,
  kKBar,
  kQBar,
  kForwardDynamics,
  kInverseDynamics,
  kKineticEnergy,
  kPotentialEnergy,
  kOutputs,
  kCloseLoops,
  kProject,
  kConstraintResidual,
  kConstraintForces,
  kResidual,
  kResidualDerivatives,
  kForwardDynamicsDerivatives,
  kLinearize,
  kSample,
};

/// As in emitted code: "forward_dynamics".
const char* name_of(FunctionId function);

/// Nothing where no function has the name.
std::optional<FunctionId> function_named(std::string_view name);

}  // namespace jourdain::ir
