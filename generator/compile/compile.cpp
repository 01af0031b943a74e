#include "compile/compile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "compile/expected_text.hpp"
#include "compile/link_by_link.hpp"
#include "compile/model_text.hpp"
#include "compile/module_check.hpp"
#include "compile/omissions.hpp"
#include "emit/c/c_files.hpp"
#include "emit/c/c_interface.hpp"
#include "emit/constant_tables.hpp"
#include "emit/cpp/model_files.hpp"
#include "loops/plan/plan.hpp"
#include "passes/lanes.hpp"
#include "passes/value_order.hpp"
#include "programs/closed_system.hpp"
#include "programs/like_limbs.hpp"
#include "programs/tree_functions.hpp"
#include "reference/massless.hpp"
#include "support/float_range.hpp"
#include "validate/loops/validation.hpp"

namespace jourdain {

using dynamics::Equations;

void check_inertia(const model::Mechanism& mechanism, support::Diagnostics& diagnostics) {
  if (!mechanism.loops.empty()) return;  // judged where they are closed
  for (const model::JointIndex index : reference::negative_joints(mechanism)) {
    const model::Joint& joint = mechanism.joints[index.value];
    diagnostics.error(joint.where, fmt::format("joint '{}' moves a negative inertia", joint.name),
                      "an indefinite inertia of a body that it moves makes the kinetic energy negative");
  }
  for (model::JointIndex index : reference::massless_joints(mechanism)) {
    const model::Joint& joint = mechanism.joints[index.value];
    diagnostics.error(
        joint.where, fmt::format("joint '{}' moves no inertia", joint.name),
        "give a body that it moves a mass or an inertia that is not lost in rounding beside the "
        "others, or make the joint fixed");
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

std::vector<double> literals_of(const ir::Module& module) {
  std::vector<double> literals;
  const auto gather = [&literals](const ir::Program& program) {
    for (const ir::Node& node : program.nodes)
      if (node.op == ir::Op::kLiteral) literals.push_back(node.literal);
  };
  gather(module.constants);
  for (const ir::Program& program : module.functions) gather(program);
  return literals;
}

/// Is one of the constants beyond the range of double?
bool overflows(const ir::Module& module) {
  return std::ranges::any_of(literals_of(module), [](double literal) { return std::isinf(literal); });
}

/// Why a module that was not accepted could not be validated, where a constant is so near to zero that the digits
/// behind its double, which validation takes, are below all doubles; empty: there is none.
std::string lost_digits(const ir::Module& module) {
  constexpr long double kShare = validate::kAlgebra / 1e3L;  // of a constant, that counts
  for (const double literal : literals_of(module))
    if (literal != 0 && std::fabs(literal) * kShare < std::numeric_limits<double>::denorm_min())
      return fmt::format(
          "a constant of the equations is {:.6g}, so near to the end of the range of double that too few "
          "digits "
          "are left to validate it",
          literal);
  return "";
}

/// What float does to a number of double; empty: not that.
using Misfit = std::string (*)(double);

/// A sentence on the first constant or parameter that has this misfit; empty: there is none.
std::string find_number(const ir::Module& module, const programs::SceneFacts& scene, Misfit misfit) {
  for (const double literal : literals_of(module))
    if (const std::string what = misfit(literal); !what.empty())
      return fmt::format("a constant of the equations, {}, {}", literal, what);
  for (const model::Parameter& parameter : scene.parameters)
    if (const std::string what = misfit(parameter.value); !what.empty())
      return fmt::format("parameter '{}', {}, {}", parameter.name, parameter.value, what);
  return "";
}

/// A sentence on the first number that is infinite as a float; empty: there is none.
std::string find_overflow(const ir::Module& module, const programs::SceneFacts& scene) {
  std::string number = find_number(module, scene, support::float_overflow);
  const std::set<std::uint32_t> arrays = emit::arrays_in(module);
  if (number.empty() && std::any_of(arrays.begin(), arrays.end(), emit::overflows_float))
    number = "a number of a table is beyond the range of float";
  return number;
}

/// The same, or on one that float has few digits for.
std::string find_misfit(const ir::Module& module, const programs::SceneFacts& scene) {
  const std::string number = find_overflow(module, scene);
  return number.empty() ? find_number(module, scene, support::float_underflow) : number;
}

}  // namespace

CompiledModel compile(const model::Mechanism& mechanism, const CompileOptions& given) {
  CompiledModel result;
  const CompileOptions options = completed(mechanism, given);
  const loops::LoopPlan* plan = options.loops ? &*options.loops : nullptr;
  result.facts = programs::scene_facts(mechanism, plan, options.wishes());
  result.functions = programs::with_needed(options.functions, result.facts);
  for (programs::FunctionInfo& function : programs::kinematic_functions(result.facts))
    result.functions.push_back(std::move(function));
  CompileOptions chosen = options;
  Equations equations;
  ir::Module lowered;
  if (plan) {
    const programs::ClosedSystem closed(mechanism, options.derivation, *plan);
    lowered = programs::lower_scene(closed, result.functions, options.derivative_terms);
    equations = closed.equations();
  } else {
    if (options.derivation.articulated.empty())
      result.articulation = choose_articulation(mechanism, options.derivation);
    result.articulation.set(chosen.derivation);
    choose_recursions(mechanism, chosen.derivation);
    equations = dynamics::derive_equations(mechanism, chosen.derivation);
    lowered = programs::lower_scene(programs::TreePrograms(mechanism, equations, options.derivation),
                                    result.functions, options.derivative_terms);
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
  if (options.choices.has_float) result.float_misfit = find_misfit(result.module, result.facts);
  if (options.choices.has_float && plan) result.weak_in_float = plan->weak_in_float();
  if (!result.weak_in_float.empty() && !options.choices.has_double) {
    result.verdict.failures = {result.weak_in_float};
    result.verdict.advice = "Double does; so may float with another treatment of the loops.";
    return result;
  }
  if (!result.float_misfit.empty() && !options.choices.has_double) {
    result.verdict.failures = {result.float_misfit};
    result.verdict.overflows = 1;
    return result;
  }
  if (options.choices.lanes) {
    const std::vector<passes::LikeLimbs> limbs = programs::like_limbs(mechanism);
    for (ir::Program& program : result.module.functions) {
      program = passes::in_lanes(program, limbs);
      if (options.choices.language == ir::Language::kC) program.lanes.clear();  // the same bits one by one
    }
  }
  for (ir::Program& program : result.module.functions) program = passes::order_values(program);
  const std::vector<std::string> defects = module_defects(result.module, result.facts);
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
  if (!result.verdict.accepted()) {
    if (const std::string why = lost_digits(result.module); !why.empty()) {
      result.verdict.failures = {why};
      result.verdict.overflows = 1;
    }
    return;
  }
  const emit::ModelText text = model_text(mechanism, options, result);
  const bool in_c = options.choices.language == ir::Language::kC;
  if (in_c && options.choices.has_float && !find_overflow(result.module, result.facts).empty()) {
    result.verdict.failures = {
        "a constant of the equations is beyond the range of float; --real double writes no floats"};
    result.verdict.overflows = 1;
    return;
  }
  result.files = in_c ? emit::c::model_files(text, result.functions, result.module)
                      : emit::cpp::model_files(text, result.functions, result.module);
  result.expected = expected_text(mechanism, options, result);
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
  if (result.files.empty() || !in_c || !options.choices.has_interface) return;
  for (emit::File& file : emit::c::interface_files(text, result.functions, result.module))
    result.files.push_back(std::move(file));
}

}  // namespace jourdain
