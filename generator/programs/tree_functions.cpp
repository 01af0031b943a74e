#include "programs/tree_functions.hpp"

#include "lowering/lower.hpp"

namespace jourdain::programs {

using dynamics::Equations;
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

/// What each emitted function computes.
std::vector<lowering::Target> targets_of(const std::string& function, const Equations& equations) {
  if (function == "position_rate") return vector_targets("ydot", equations.ydot);
  if (function == "outputs") return output_targets(equations);
  if (function == "mass_matrix") return matrix_targets(equations.M);
  if (function == "k_bar") return vector_targets("k", equations.k_bar);
  if (function == "q_bar") return vector_targets("q", equations.q_bar);
  if (function == "forward_dynamics") return vector_targets("zdot", equations.zdot);
  if (function == "inverse_dynamics") return vector_targets("tau", equations.tau);
  if (function == "residual") return vector_targets("r", equations.residual);
  if (function == "kinetic_energy") return {{"T", -1, -1, equations.kinetic_energy}};
  if (function == "potential_energy") return {{"V", -1, -1, equations.potential_energy}};
  JD_CHECK(function == "initial_state", "no targets for '{}'", function);
  std::vector<lowering::Target> targets = vector_targets("y", equations.initial_position);
  for (const lowering::Target& target : vector_targets("z", equations.initial_velocity))
    targets.push_back(target);
  return targets;
}

}  // namespace

ir::Program lower_function(const Equations& equations, const std::string& function) {
  return lowering::lower(equations.statements, targets_of(function, equations), function);
}

}  // namespace jourdain::programs
