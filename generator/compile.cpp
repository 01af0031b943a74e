#include "compile.hpp"

#include <fmt/format.h>

#include "ir/lower.hpp"
#include "model/names.hpp"
#include "omissions.hpp"
#include "reference/massless.hpp"

namespace jourdain {

using dynamics::Equations;
using kinematics::Ex;

namespace {

std::vector<ir::Target> vector_targets(const std::string& name, const std::vector<Ex>& values) {
  std::vector<ir::Target> targets;
  for (std::size_t i = 0; i < values.size(); ++i)
    targets.push_back({name, static_cast<int>(i), -1, values[i]});
  return targets;
}

/// Upper triangle; the emitter fills both.
std::vector<ir::Target> matrix_targets(const std::vector<std::vector<Ex>>& M) {
  std::vector<ir::Target> targets;
  for (std::size_t i = 0; i < M.size(); ++i)
    for (std::size_t j = i; j < M.size(); ++j)
      targets.push_back({"M", static_cast<int>(i), static_cast<int>(j), M[i][j]});
  return targets;
}

/// What each emitted function computes.
std::vector<ir::Target> targets_of(const std::string& function, const Equations& equations) {
  if (function == "mass_matrix") return matrix_targets(equations.M);
  if (function == "k_bar") return vector_targets("k", equations.k_bar);
  if (function == "q_bar") return vector_targets("q", equations.q_bar);
  if (function == "forward_dynamics") return vector_targets("zdot", equations.zdot);
  if (function == "inverse_dynamics") return vector_targets("tau", equations.tau);
  if (function == "kinetic_energy") return {{"T", -1, -1, equations.kinetic_energy}};
  if (function == "potential_energy") return {{"V", -1, -1, equations.potential_energy}};
  JD_CHECK(function == "initial_state", "no targets for '{}'", function);
  std::vector<ir::Target> targets = vector_targets("y", equations.initial_position);
  for (const ir::Target& target : vector_targets("z", equations.initial_velocity)) targets.push_back(target);
  return targets;
}

emit::ModelText model_text(const model::Mechanism& mechanism, const CompileOptions& options) {
  emit::ModelText text;
  text.name = options.name.empty() ? model::cpp_name(mechanism.name) : options.name;
  text.title = mechanism.name;
  text.description = mechanism.description;
  text.numbers_from = mechanism.source;
  text.path = options.path;
  text.sha256 = options.sha256;
  for (model::JointIndex joint : model::moving_joints(mechanism)) {
    text.positions.push_back(mechanism.joints[joint.value].name);
    text.velocities.push_back(mechanism.joints[joint.value].name);
  }
  for (const model::Actuator& actuator : mechanism.actuators) text.inputs.push_back(actuator.name);
  for (const model::Parameter& parameter : mechanism.parameters)
    text.parameters.push_back({parameter.name, parameter.value, parameter.unit, parameter.description});
  return text;
}

std::string validation_sentence(const validate::Verdict& verdict) {
  return fmt::format(
      "{} random states: backward error of M zdot = k_bar - q_bar {:.1e} of the sum of absolute terms "
      "against 60-digit "
      "arithmetic, entries of the functions {:.1e}; symbolic equations against the numeric reference {:.1e}; "
      "cond(M) up to {:.1e}",
      verdict.states, verdict.backward_error, verdict.entry_error, verdict.reference_error,
      verdict.condition);
}

std::vector<std::string> assumptions(const model::Mechanism& mechanism, const CompileOptions& options,
                                     const validate::Verdict& verdict) {
  std::vector<std::string> list = {"bodies are rigid; joints are ideal and without limits"};
  if (!options.damping) list.push_back("joint damping of the description is left out (--no-damping)");
  if (mechanism.snap && verdict.snap_effect > 1e-15)
    list.push_back(
        fmt::format("rotation entries within {:g} of 0 and +-1 are exact; that changes accelerations by "
                    "{:.1e} at most (norm over norm)",
                    model::kSnapTolerance, verdict.snap_effect));
  return list;
}

}  // namespace

ir::Module lower_functions(const Equations& equations, const std::vector<emit::FunctionInfo>& functions) {
  ir::Module module;
  for (const emit::FunctionInfo& function : functions)
    if (function.shape != emit::Shape::kStep)
      module.functions.push_back(
          ir::lower(equations.statements, targets_of(function.name, equations), function.name));
  return module;
}

void check_inertia(const model::Mechanism& mechanism, support::Diagnostics& diagnostics) {
  for (model::JointIndex index : reference::massless_joints(mechanism)) {
    const model::Joint& joint = mechanism.joints[index.value];
    diagnostics.error(joint.where, fmt::format("joint '{}' moves no inertia", joint.name),
                      "give a body that it moves a mass or an inertia, or make the joint fixed");
  }
}

CompiledModel compile(const model::Mechanism& mechanism, const CompileOptions& options) {
  CompiledModel result;
  result.functions = emit::with_needed(options.functions);
  const Equations equations = dynamics::derive_equations(mechanism, options.derivation);
  passes::Optimised optimised =
      passes::optimise(lower_functions(equations, result.functions), options.passes_off);
  result.module = std::move(optimised.module);
  result.passes = std::move(optimised.records);
  result.omissions = find_omissions(mechanism, options, equations, result);
  validate_and_emit(mechanism, equations, options, result);
  return result;
}

void validate_and_emit(const model::Mechanism& mechanism, const Equations& equations,
                       const CompileOptions& options, CompiledModel& result) {
  result.files.clear();
  result.verdict = validate::validate_translation(mechanism, equations, result.module);
  result.assumptions = assumptions(mechanism, options, result.verdict);
  if (!result.verdict.accepted()) return;
  emit::ModelText text = model_text(mechanism, options);
  text.assumptions = result.assumptions;
  for (const Omission& omission : result.omissions)
    text.left_out.push_back(omission.saved == 0 ? omission.name + ": " + omission.what
                                                : fmt::format("{}: {} ({} operations of forward_dynamics)",
                                                              omission.name, omission.what, omission.saved));
  text.validation = validation_sentence(result.verdict);
  text.backward_error = result.verdict.backward_error;
  text.condition = result.verdict.condition;
  result.files = emit::emit_files(text, result.functions, result.module);
}

}  // namespace jourdain
