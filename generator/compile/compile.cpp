#include "compile/compile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compile/expected_text.hpp"
#include "compile/module_check.hpp"
#include "compile/omissions.hpp"
#include "emit/body.hpp"
#include "loops/plan/plan.hpp"
#include "loops/plan/plan_text.hpp"
#include "model/coordinates.hpp"
#include "model/names.hpp"
#include "programs/closed_system.hpp"
#include "programs/loop_outputs.hpp"
#include "programs/tree_functions.hpp"
#include "reference/massless.hpp"
#include "validate/loops/validation.hpp"
#include "validate/snapping.hpp"

namespace jourdain {

using dynamics::Equations;

namespace {

/// What an output is, in words.
std::string describe(const model::Mechanism& mechanism, const model::Output& output) {
  const auto frame = [&] { return mechanism.frames[output.frame.value].name; };
  const auto joint = [&] { return mechanism.joints[output.joint.value].name; };
  switch (output.kind) {
    case model::OutputKind::kPose:
      return fmt::format("Position (inertial frame) and rotation matrix (frame to inertial) of '{}'.",
                         frame());
    case model::OutputKind::kVelocity:
      return fmt::format("Velocity (inertial frame) and angular velocity (frame components) of '{}'.",
                         frame());
    case model::OutputKind::kAcceleration:
      return fmt::format("Acceleration (inertial frame) and angular acceleration (frame components) of '{}'.",
                         frame());
    case model::OutputKind::kJacobian:
      return fmt::format(
          "Jacobians of '{}': v = J_t z + v_bar, a = J_t zdot + a_bar (inertial frame); omega = J_r z + "
          "omega_bar, "
          "omega_dot = J_r zdot + zeta_bar (frame components).",
          frame());
    case model::OutputKind::kReaction:
      return fmt::format("What joint '{}' transmits to its child, at the child's origin, child components.",
                         joint());
    case model::OutputKind::kDrive:
      return fmt::format("Force or torque that the prescribed motion of '{}' needs.",
                         mechanism.joints[output.joint.value].coordinates[output.coordinate].name);
    case model::OutputKind::kKineticEnergy:
      return "Kinetic energy, J.";
    case model::OutputKind::kPotentialEnergy:
      return "Potential energy, J.";
    case model::OutputKind::kExpression:
      return "Expression of the model description.";
  }
  return "";
}

std::vector<emit::OutputDeclaration> output_texts(
    const model::Mechanism& mechanism, const std::vector<std::vector<dynamics::OutputValues>>& outputs) {
  std::vector<emit::OutputDeclaration> texts;
  for (std::size_t k = 0; k < mechanism.outputs.size(); ++k) {
    emit::OutputDeclaration& text = texts.emplace_back();
    text.name = mechanism.outputs[k].name;
    text.comment = describe(mechanism, mechanism.outputs[k]);
    for (const dynamics::OutputValues& member : outputs[k])
      text.members.push_back({member.member, member.rows, member.columns, member.is_matrix});
  }
  return texts;
}

std::vector<emit::ProvenText> texts_of(const std::vector<loops::ProvenRange>& ranges) {
  std::vector<emit::ProvenText> texts;
  for (const loops::ProvenRange& range : ranges) texts.push_back({range.index, range.low, range.high});
  return texts;
}

/// Names, tangent and sentences of a mechanism with loops.
void describe_loops(const model::Mechanism& mechanism, const loops::LoopPlan& plan, emit::ModelText& text) {
  text.constraints = loops::row_names(mechanism);
  text.dependents = programs::dependent_positions(plan, text.tangent);
  text.closings = plan.closings();
  text.loops = loops::sentences(mechanism, plan);
  text.least_regularity = plan.least_regularity();
  text.greatest_opening = plan.greatest_opening();
  text.opening_is_proven = plan.proof.has_value();
  if (const loops::ProvenBox* box = plan.proven()) {
    text.proven_positions = texts_of(box->positions);
    text.proven_parameters = texts_of(box->parameters);
  }
  if (!plan.is_reduced()) return;
  text.tangent = programs::independent_tangent(plan, text.tangent);
  const std::vector<std::string> all = std::move(text.velocities);
  text.velocities.clear();
  for (const std::size_t k : plan.independent) text.velocities.push_back(all[k]);
}

emit::ModelText model_text(const model::Mechanism& mechanism, const CompileOptions& options) {
  emit::ModelText text;
  text.name = options.name.empty() ? model::cpp_name(mechanism.name) : options.name;
  text.title = mechanism.name;
  text.description = mechanism.description;
  text.numbers_from = mechanism.source;
  text.path = options.path;
  text.sha256 = options.sha256;
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  text.positions = layout.position_names;
  text.velocities = layout.velocity_names;
  text.inputs = layout.input_names;
  text.tangent = model::tangent_of(mechanism, layout);
  text.time = model::time_dependence(mechanism);
  text.clock = shape_of(mechanism).clock || options.clock;
  text.all_derivatives = options.derivative_terms == programs::DerivativeTerms::kAll;
  if (options.loops) describe_loops(mechanism, *options.loops, text);
  for (const model::Parameter& parameter : mechanism.parameters)
    text.parameters.push_back(
        {parameter.name, parameter.value, parameter.unit, parameter.description, parameter.range});
  return text;
}

std::vector<std::string> left_out_sentences(const std::vector<Omission>& omissions) {
  std::vector<std::string> sentences;
  for (const Omission& omission : omissions)
    sentences.push_back(omission.saved == 0 ? omission.name + ": " + omission.what
                                            : fmt::format("{}: {} ({} operations of forward_dynamics)",
                                                          omission.name, omission.what, omission.saved));
  return sentences;
}

/// What was compared with what, a sentence each; first how well.
std::vector<std::string> validation_sentences(const validate::Verdict& verdict) {
  std::vector<std::string> list = {fmt::format(
      "validated at {} states: in 77 digits everything below agrees to {:g} of its scale (what rounding can "
      "move it by, over the unit roundoff). In double the backward error of M zdot = k_bar - q_bar is {:.1e} "
      "of the sum of absolute terms, other errors are {:.1e} of their scale; cond(M) up to {}",
      verdict.states, static_cast<double>(validate::kAlgebra), verdict.backward_error, verdict.entry_error,
      validate::condition_text(verdict))};
  std::string equations;
  for (const validate::Compared& c : verdict.compared)
    if (c.oracle == validate::kReference) equations += (equations.empty() ? "" : ", ") + c.function;
  list.push_back(fmt::format("the symbolic equations ({}): {}", equations, validate::kReference));
  for (const validate::Compared& c : verdict.compared)
    if (c.oracle != validate::kReference) list.push_back(fmt::format("{}: {}", c.function, c.oracle));
  return list;
}

std::vector<std::string> assumptions(const model::Mechanism& mechanism, const CompileOptions& options,
                                     const CompiledModel& compiled) {
  std::vector<std::string> list = {"bodies are rigid; joints are ideal and without limits"};
  if (!options.damping) list.push_back("joint damping of the description is left out (--no-damping)");
  for_each_force_list(mechanism, [&list]<class Element>(const std::vector<Element>& elements) {
    const std::string sentence = Element::assumption();
    if (!elements.empty() && !sentence.empty()) list.push_back(sentence);
  });
  const bool rotors = std::any_of(mechanism.actuators.begin(), mechanism.actuators.end(),
                                  [](const model::Actuator& a) { return !a.rotor_inertia.is_zero(); });
  if (rotors)
    list.push_back("rotors add gear_ratio^2 rotor_inertia to M; their gyroscopic coupling is neglected");
  if (options.derivative_terms == programs::DerivativeTerms::kApplied)
    list.push_back(
        "derivatives of the residual hold those of applied forces but gravity alone (--derivatives applied)");
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  if (!layout.quaternions.empty())
    list.push_back("quaternions are near unit length; a step ends with unit length");
  if (const std::string sentence = accuracy_sentence(compiled.articulation); !sentence.empty())
    list.push_back(sentence);
  if (compiled.shape.clock) list.push_back("time is a sum of three numbers, which 7 additions move");
  if (std::any_of(compiled.module.functions.begin(), compiled.module.functions.end(), emit::turns_with_time))
    list.push_back(
        "angles that follow from time are sums of two numbers, so that the phase stays right: operation "
        "counts hold "
        "each of their operations, sines and cosines as one, it takes several (see detail::Angle)");
  if (!mechanism.indefinite.empty())
    list.push_back(
        fmt::format("M need not be positive definite everywhere: indefinite, as the description has it, is "
                    "the inertia of {}",
                    fmt::join(mechanism.indefinite, ", ")));
  if (!mechanism.welded.empty())
    list.push_back(fmt::format("joints beyond which is no mass are held at zero: {}",
                               fmt::join(mechanism.welded, ", ")));
  if (!mechanism.snapped.empty())
    list.push_back(fmt::format("angles and axes within {:g} rad of a right angle are exact; {}",
                               mechanism.snapped.tolerance, validate::snapping_sentence(mechanism)));
  return list;
}

}  // namespace

ir::Module lower_functions(const Equations& equations, const std::vector<programs::FunctionInfo>& functions) {
  ir::Module module;
  for (const programs::FunctionInfo& function : functions)
    if (function.shape != programs::Shape::kStep && !function.holds_derivatives)
      module.functions.push_back(programs::lower_function(equations, function.name));
  return module;
}

programs::SceneShape shape_of(const model::Mechanism& mechanism, const loops::LoopPlan* plan) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  programs::SceneShape shape;
  shape.positions = layout.position_count();
  shape.velocities = layout.velocity_count();
  shape.quaternions = layout.quaternions.size();
  shape.outputs = mechanism.outputs.size();
  shape.inputs = layout.input_count();
  shape.time = model::time_dependence(mechanism);
  shape.clock = shape.time.any() || shape.inputs > 0;
  if (!plan) return shape;
  shape.constraints = plan->row_length.size();
  shape.has_dependents = plan->is_reduced();
  shape.closings = plan->closings();
  if (plan->is_reduced()) shape.velocities = plan->independent.size();
  return shape;
}

void check_inertia(const model::Mechanism& mechanism, support::Diagnostics& diagnostics) {
  if (!mechanism.loops.empty()) return;  // judged where they are closed
  for (const model::JointIndex index : reference::negative_joints(mechanism)) {
    const model::Joint& joint = mechanism.joints[index.value];
    diagnostics.error(joint.where, fmt::format("joint '{}' moves a negative inertia", joint.name),
                      "an indefinite inertia of a body that it moves makes the kinetic energy negative");
  }
  for (model::JointIndex index : reference::massless_joints(mechanism)) {
    const model::Joint& joint = mechanism.joints[index.value];
    diagnostics.error(joint.where, fmt::format("joint '{}' moves no inertia", joint.name),
                      "give a body that it moves a mass or an inertia, or make the joint fixed");
  }
}

namespace {

/// `options` with what only the compiler decides.
CompileOptions completed(const model::Mechanism& mechanism, const CompileOptions& options) {
  CompileOptions chosen = options;
  if (mechanism.loops.empty() || options.loops) return chosen;
  support::Diagnostics diagnostics("model", "");
  chosen.loops = loops::plan_loops(mechanism, diagnostics);
  JD_CHECK(chosen.loops, "loops that were not checked: {}", diagnostics.format());
  return chosen;
}

/// Is one of the constants beyond the range of double?
bool overflows(const ir::Module& module) {
  const auto has_overflow = [](const ir::Program& program) {
    return std::any_of(program.nodes.begin(), program.nodes.end(), [](const ir::Node& node) {
      return node.op == ir::Op::kLiteral && std::isinf(node.literal);
    });
  };
  return has_overflow(module.constants) ||
         std::any_of(module.functions.begin(), module.functions.end(), has_overflow);
}

ir::Module lower_tree(const model::Mechanism& mechanism, const CompileOptions& options,
                      const Equations& equations, const std::vector<programs::FunctionInfo>& functions) {
  ir::Module lowered = lower_functions(equations, functions);
  if (!programs::any_derivatives(functions)) return lowered;
  for (ir::Program& program : programs::derivative_programs(
           programs::tree_sources(mechanism, options.derivation), functions, options.derivative_terms))
    lowered.functions.push_back(std::move(program));
  return lowered;
}

ir::Module lower_closed(const programs::ClosedSystem& closed, const CompileOptions& options,
                        const std::vector<programs::FunctionInfo>& functions) {
  ir::Module lowered;
  for (const programs::FunctionInfo& function : functions)
    if (function.shape != programs::Shape::kStep && !function.holds_derivatives)
      lowered.functions.push_back(programs::loop_program(closed.system(), function.name));
  if (!programs::any_derivatives(functions)) return lowered;
  for (ir::Program& program : programs::derivative_programs(programs::derivative_sources(closed.system()),
                                                            functions, options.derivative_terms))
    lowered.functions.push_back(std::move(program));
  return lowered;
}

}  // namespace

CompiledModel compile(const model::Mechanism& mechanism, const CompileOptions& given) {
  CompiledModel result;
  const CompileOptions options = completed(mechanism, given);
  const loops::LoopPlan* plan = options.loops ? &*options.loops : nullptr;
  result.shape = shape_of(mechanism, plan);
  result.shape.clock = result.shape.clock || options.clock;
  result.all_derivatives = options.derivative_terms == programs::DerivativeTerms::kAll;
  result.tangent = model::tangent_of(mechanism, model::lay_out_coordinates(mechanism));
  if (plan) result.dependents = programs::dependent_positions(*plan, result.tangent);
  if (plan && plan->is_reduced()) result.tangent = programs::independent_tangent(*plan, result.tangent);
  for (const model::Parameter& parameter : mechanism.parameters)
    result.parameter_names.push_back(parameter.name);
  result.functions = programs::with_needed(options.functions, result.shape);
  CompileOptions chosen = options;
  Equations equations;
  ir::Module lowered;
  if (plan) {
    const programs::ClosedSystem closed(mechanism, options.derivation, *plan);
    lowered = lower_closed(closed, options, result.functions);
    equations = closed.equations();
  } else {
    if (options.derivation.articulated.empty())
      result.articulation = choose_articulation(mechanism, options.derivation);
    result.articulation.set(chosen.derivation);
    equations = dynamics::derive_equations(mechanism, chosen.derivation);
    lowered = lower_tree(mechanism, options, equations, result.functions);
  }
  if (options.watch) options.watch({"lower"}, lowered);
  passes::Optimised optimised = passes::optimise(std::move(lowered), options.passes_off, options.watch);
  result.module = std::move(optimised.module);
  result.passes = std::move(optimised.records);
  if (overflows(result.module)) {
    result.verdict.failures = {"a constant of the equations is beyond the range of double"};
    result.verdict.overflows = 1;
    return result;
  }
  const std::vector<std::string> defects =
      module_defects(result.module, result.shape, mechanism.parameters.size());
  JD_CHECK(defects.empty(), "broken program, {}", defects.front());
  result.omissions = find_omissions(mechanism, chosen, equations, result);
  validate_and_emit(mechanism, equations, options, result);
  return result;
}

namespace {

Equations weightless(model::Mechanism mechanism) {
  mechanism.gravity = {0.0, 0.0, 0.0};
  return dynamics::derive_equations(mechanism);
}

}  // namespace

void validate_and_emit(const model::Mechanism& mechanism, const Equations& equations,
                       const CompileOptions& options, CompiledModel& result) {
  result.files.clear();
  std::optional<Equations> load;
  if (options.derivative_terms == programs::DerivativeTerms::kApplied) load = weightless(mechanism);
  result.verdict =
      options.loops
          ? validate::validate_closed(mechanism, equations, result.module, *options.loops)
          : validate::validate_translation(mechanism, equations, result.module, 8, load ? &*load : nullptr);
  result.assumptions = assumptions(mechanism, options, result);
  if (!result.verdict.accepted()) return;
  emit::ModelText text = model_text(mechanism, options);
  result.outputs = output_texts(
      mechanism, options.loops ? programs::resized_outputs(mechanism, *options.loops, equations.outputs)
                               : equations.outputs);
  text.outputs = result.outputs;
  text.assumptions = result.assumptions;
  text.left_out = left_out_sentences(result.omissions);
  text.validation = validation_sentences(result.verdict);
  text.backward_error = result.verdict.backward_error;
  text.condition = result.verdict.condition;
  result.files = emit::emit_files(text, result.functions, result.module);
  result.expected = expected_text(mechanism, options, equations, result);
  result.expected.left_out = left_out_sentences(result.omissions);
  for (const std::string& sentence : result.expected.left_out) result.expected.sentences.push_back(sentence);
  for (const std::string& sentence : validation_sentences(result.verdict))
    result.expected.sentences.push_back(sentence);
  readback::Expected expected = result.expected;
  expected.module = &result.module;
  const readback::Readback read = readback::read_back(result.files, expected);
  result.readback = read.record;
  for (const std::string& difference : read.differences)
    result.verdict.failures.push_back("text: " + difference);
  if (!read.differences.empty()) result.files.clear();
}

}  // namespace jourdain
