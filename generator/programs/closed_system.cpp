#include "programs/closed_system.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "passes/pipeline.hpp"
#include "programs/kinematic_programs.hpp"
#include "programs/tree_functions.hpp"

namespace jourdain::programs {

using ir::FunctionId;

namespace {

dynamics::DerivationOptions for_residual(dynamics::DerivationOptions options) {
  options.articulated.clear();
  options.for_derivatives = true;
  return options;
}

}  // namespace

ClosedSystem::ClosedSystem(const model::Mechanism& mechanism, const dynamics::DerivationOptions& options,
                           const loops::LoopPlan& plan)
    : equations_(dynamics::derive_equations(mechanism, for_residual(options))),
      system_{constraints_, plan, mechanism, model::lay_out_coordinates(mechanism), {}} {
  system_.tree = [this](FunctionId function) { return tree(function); };
  choose(loops::constraint_programs(mechanism, equations_));
}

/// Those with which accelerations take the fewest operations.
void ClosedSystem::choose(const std::vector<loops::ConstraintPrograms>& list) {
  std::size_t best = 0, fewest = 0;
  for (std::size_t k = 0; k < list.size() && list.size() > 1; ++k) {
    constraints_ = list[k];
    const std::size_t operations =
        passes::remaining_operations(loop_program(system_, FunctionId::kForwardDynamics));
    if (k == 0 || operations < fewest) {
      best = k;
      fewest = operations;
    }
  }
  constraints_ = list[best];
}

const ir::Program& ClosedSystem::tree(FunctionId function) {
  const auto known = lowered_.find(function);
  if (known != lowered_.end()) return known->second;
  return lowered_[function] = lower_function(equations_, function);
}

ir::Program ClosedSystem::program(FunctionId function) const { return loop_program(system_, function); }

ir::Program ClosedSystem::kinematic_program(std::size_t k) const {
  return loop_kinematics(equations_, system_, k);
}

DerivativeSources ClosedSystem::derivative_sources() const { return programs::derivative_sources(system_); }

}  // namespace jourdain::programs
