#include "programs/tree_functions.hpp"

#include "lowering/lower.hpp"
#include "programs/kinematic_programs.hpp"

namespace jourdain::programs {

using dynamics::Equations;
using ir::FunctionId;
using ir::name_of;
using kinematics::Ex;

namespace {

std::vector<lowering::Target> vector_targets(const std::string& name, const std::vector<Ex>& values) {
  std::vector<lowering::Target> targets;
  for (std::size_t i = 0; i < values.size(); ++i)
    targets.push_back({name, static_cast<int>(i), -1, values[i]});
  return targets;
}

/// Upper triangle; the emitter fills both.
std::vector<lowering::Target> matrix_targets(const std::vector<std::vector<Ex>>& M) {
  std::vector<lowering::Target> targets;
  for (std::size_t i = 0; i < M.size(); ++i)
    for (std::size_t j = i; j < M.size(); ++j)
      targets.push_back({"M", static_cast<int>(i), static_cast<int>(j), M[i][j]});
  return targets;
}

/// Entries of z that are sampled.
std::vector<lowering::Target> sample_targets(const Equations& equations) {
  std::vector<lowering::Target> targets;
  for (const dynamics::SampledState& sampled : equations.samples)
    targets.push_back({"z", static_cast<int>(sampled.entry), -1, sampled.value});
  return targets;
}

std::vector<lowering::Target> output_targets(const Equations& equations) {
  std::vector<lowering::Target> targets;
  for (std::size_t k = 0; k < equations.outputs.size(); ++k)
    for (const dynamics::OutputValues& member : equations.outputs[k]) {
      const std::string name = equations.output_names[k] + (member.member.empty() ? "" : "." + member.member);
      for (std::size_t i = 0; i < member.values.size(); ++i) {
        const int entry = static_cast<int>(i);
        targets.push_back({name, member.rows > 1 ? entry / member.columns : -1,
                           member.is_matrix ? entry % member.columns : -1, member.values[i]});
      }
    }
  return targets;
}

/// What each emitted function computes; of those with derivatives the residual alone.
std::vector<lowering::Target> targets_of(FunctionId function, const Equations& equations) {
  switch (function) {
    case FunctionId::kInitialState: {
      std::vector<lowering::Target> targets = vector_targets("y", equations.initial_position);
      for (const lowering::Target& target : vector_targets("z", equations.initial_velocity))
        targets.push_back(target);
      return targets;
    }
    case FunctionId::kPositionRate:
      return vector_targets("ydot", equations.ydot);
    case FunctionId::kMassMatrix:
      return matrix_targets(equations.M);
    case FunctionId::kKBar:
      return vector_targets("k", equations.k_bar);
    case FunctionId::kQBar:
      return vector_targets("q", equations.q_bar);
    case FunctionId::kForwardDynamics:
      return vector_targets("zdot", equations.zdot);
    case FunctionId::kInverseDynamics:
      return vector_targets("tau", equations.tau);
    case FunctionId::kKineticEnergy:
      return {{"T", -1, -1, equations.kinetic_energy}};
    case FunctionId::kPotentialEnergy:
      return {{"V", -1, -1, equations.potential_energy}};
    case FunctionId::kOutputs:
      return output_targets(equations);
    case FunctionId::kSample:
      return sample_targets(equations);
    case FunctionId::kResidual:
      return vector_targets("r", equations.residual);
    case FunctionId::kCloseLoops:
    case FunctionId::kProject:
    case FunctionId::kConstraintResidual:
    case FunctionId::kConstraintForces:
    case FunctionId::kResidualDerivatives:
    case FunctionId::kForwardDynamicsDerivatives:
    case FunctionId::kLinearize:
      break;
  }
  JD_CHECK(false, "no targets for '{}'", name_of(function));
  return {};
}

}  // namespace

ir::Program lower_function(const Equations& equations, FunctionId function) {
  return lowering::lower(equations.statements, targets_of(function, equations), name_of(function));
}

ir::Module lower_functions(const Equations& equations, const std::vector<FunctionInfo>& functions) {
  ir::Module module;
  for (const FunctionInfo& function : functions)
    if (function.id && !function.holds_derivatives)
      module.functions.push_back(lower_function(equations, *function.id));
  return module;
}

ir::Program TreePrograms::program(FunctionId function) const { return lower_function(equations_, function); }

ir::Program TreePrograms::kinematic_program(std::size_t k) const {
  return tree_kinematics(equations_, mechanism_, k);
}

DerivativeSources TreePrograms::derivative_sources() const { return tree_sources(mechanism_, options_); }

}  // namespace jourdain::programs
