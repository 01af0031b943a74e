#include "compile/model_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/body.hpp"
#include "loops/plan/plan_text.hpp"
#include "model/coordinates.hpp"
#include "model/names.hpp"
#include "passes/lanes.hpp"
#include "validate/snapping.hpp"

namespace jourdain {

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
  if (!model::lay_out_coordinates(mechanism).quaternions.empty())
    list.push_back("quaternions are near unit length; a step ends with unit length");
  if (const std::string sentence = accuracy_sentence(compiled.articulation); !sentence.empty())
    list.push_back(sentence);
  for (const ir::Program& program : compiled.module.functions)
    if (program.name == "forward_dynamics" && !program.lanes.empty())
      list.push_back(fmt::format(
          "limbs that are alike are computed at once, as lanes of vectors: {} of {} operations of "
          "forward_dynamics go with others (--no-lanes: one after the other)",
          passes::saved_by_lanes(program), ir::count_operations(program).arithmetic()));
  if (compiled.facts.clock) list.push_back("time is a sum of three numbers, which 7 additions move");
  if (emit::any_turns_with_time(compiled.module))
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

std::vector<std::string> left_out_sentences(const std::vector<Omission>& omissions) {
  std::vector<std::string> sentences;
  for (const Omission& omission : omissions)
    sentences.push_back(omission.saved == 0 ? omission.name + ": " + omission.what
                                            : fmt::format("{}: {} ({} operations of forward_dynamics)",
                                                          omission.name, omission.what, omission.saved));
  return sentences;
}

std::vector<std::string> validation_sentences(const validate::Verdict& verdict) {
  std::vector<std::string> list = {fmt::format(
      "validated at {} states: in 77 digits everything below agrees to {} of its scale (what rounding can "
      "move it by, over the unit roundoff). In double the backward error of M zdot = k_bar - q_bar is {:.1e} "
      "of the sum of absolute terms, other errors are {:.1e} of their scale; cond(M) up to {}",
      verdict.states, validate::algebra_text(verdict), verdict.backward_error, verdict.entry_error,
      validate::condition_text(verdict))};
  if (verdict.kinks.count > 0) list.push_back(validate::in_words(verdict.kinks));
  std::string equations;
  for (const validate::Compared& c : verdict.compared)
    if (c.oracle == validate::kReference) equations += (equations.empty() ? "" : ", ") + c.function;
  list.push_back(fmt::format("the symbolic equations ({}): {}", equations, validate::kReference));
  for (const validate::Compared& c : verdict.compared)
    if (c.oracle != validate::kReference) list.push_back(fmt::format("{}: {}", c.function, c.oracle));
  return list;
}

namespace {

void describe_loops(const model::Mechanism& mechanism, const loops::LoopPlan& plan, emit::ModelText& text) {
  text.loops = loops::sentences(mechanism, plan);
  text.least_regularity = plan.least_regularity();
  text.greatest_opening = plan.greatest_opening();
  text.opening_is_proven = plan.proof.has_value();
  text.searches = std::any_of(mechanism.loops.begin(), mechanism.loops.end(),
                              [](const model::Loop& loop) { return !loop.height.is_zero(); });
  if (plan.proven()) text.proven = *plan.proven();
}

}  // namespace

emit::ModelText model_text(const model::Mechanism& mechanism, const CompileOptions& options,
                           const CompiledModel& compiled) {
  emit::ModelText text;
  text.choices = options.choices;
  text.name = options.name.empty() ? model::cpp_name(mechanism.name) : options.name;
  text.title = mechanism.name;
  text.description = mechanism.description;
  text.numbers_from = mechanism.source;
  text.path = options.path;
  text.sha256 = options.sha256;
  text.imported = options.imported;
  text.options = options.words;
  text.facts = compiled.facts;
  text.variables =
      programs::variables_of(mechanism, options.loops ? &*options.loops : nullptr, compiled.facts);
  if (options.loops) describe_loops(mechanism, *options.loops, text);
  text.assumptions = compiled.assumptions;
  text.left_out = left_out_sentences(compiled.omissions);
  text.validation = validation_sentences(compiled.verdict);
  text.backward_error = compiled.verdict.backward_error;
  text.condition = compiled.verdict.condition;
  return text;
}

}  // namespace jourdain
