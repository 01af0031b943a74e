#include "mutants/subject.hpp"

#include <cmath>

#include "agreement/judge.hpp"
#include "loops/plan/plan.hpp"
#include "model/coordinates.hpp"
#include "programs/closed_system.hpp"
#include "programs/functions.hpp"
#include "programs/loop_functions.hpp"
#include "programs/tree_functions.hpp"
#include "properties/random.hpp"
#include "validate/loops/exact_state.hpp"
#include "validate/loops/validation.hpp"

namespace jourdain::tests {

using ir::LeafKind;

namespace {

std::vector<programs::FunctionInfo> every_function(const model::Mechanism& mechanism,
                                                   const std::optional<loops::LoopPlan>& plan) {
  std::vector<programs::FunctionInfo> functions;
  const programs::SceneFacts scene = programs::scene_facts(mechanism, plan ? &*plan : nullptr);
  for (const programs::FunctionInfo& function : programs::all_functions())
    if (function.shape != programs::Shape::kStep && has_function(function, scene))
      functions.push_back(function);
  return functions;
}

}  // namespace

ir::Module programs_of(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                       const std::optional<loops::LoopPlan>& plan) {
  const std::vector<programs::FunctionInfo> functions = every_function(mechanism, plan);
  ir::Module module;
  if (plan) {
    const programs::ClosedSystem closed(mechanism, {}, *plan);
    module = programs::lower_scene(closed, functions, programs::DerivativeTerms::kAll);
  } else {
    module = programs::lower_scene(programs::TreePrograms(mechanism, equations, {}), functions,
                                   programs::DerivativeTerms::kAll);
  }
  return passes::optimise(std::move(module)).module;
}

std::optional<loops::LoopPlan> plan_of(const model::Mechanism& mechanism) {
  if (mechanism.loops.empty()) return {};
  support::Diagnostics diagnostics("model", "");
  const std::optional<loops::LoopPlan> plan = loops::plan_loops(mechanism, diagnostics);
  JD_CHECK(plan, "{}", diagnostics.format());
  return plan;
}

Subject subject_of(const std::string& name, model::Mechanism mechanism) {
  Subject subject{name, std::move(mechanism), {}, {}, {}};
  subject.plan = plan_of(subject.mechanism);
  dynamics::DerivationOptions options;
  options.for_derivatives = subject.plan.has_value();
  subject.equations = dynamics::derive_equations(subject.mechanism, options);
  subject.module = programs_of(subject.mechanism, subject.equations, subject.plan);
  return subject;
}

bool refuses(const model::Mechanism& mechanism, const dynamics::Equations& equations,
             const std::optional<loops::LoopPlan>& plan, const ir::Module& module) {
  const validate::Verdict verdict = plan ? validate::validate_closed(mechanism, equations, module, *plan)
                                         : validate::validate_translation(mechanism, equations, module);
  return !verdict.accepted();
}

std::vector<ir::LeafValues<double>> random_states(const Subject& subject, std::size_t count) {
  std::vector<ir::LeafValues<double>> states;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    Random random(seed + 400);
    const Sample sample = random_sample(subject.mechanism, seed);
    ir::LeafValues<double>& leaves = states.emplace_back();
    leaves[LeafKind::kParameter] = sample.parameters;
    leaves[LeafKind::kPosition] = sample.y;
    for (std::size_t i = 0; subject.plan && i < sample.y.size(); ++i)
      leaves[LeafKind::kPosition][i] = subject.plan->y[i] + random.uniform(-0.1, 0.1);
    for (const std::size_t q : model::lay_out_coordinates(subject.mechanism).quaternions)
      for (std::size_t i = q; i < q + 4; ++i) leaves[LeafKind::kPosition][i] *= 1.03;
    leaves[LeafKind::kVelocity] = sample.z;
    leaves[LeafKind::kAcceleration] = sample.zdot;
    leaves[LeafKind::kInput] = sample.u;
    leaves[LeafKind::kTime] = {sample.t};
    leaves[LeafKind::kStepLength] = {sample.h};
  }
  return states;
}

std::vector<ir::LeafValues<double>> lawful_states(const Subject& subject, std::size_t count) {
  std::vector<ir::LeafValues<double>> states = random_states(subject, count);
  const model::Mechanism& mechanism = subject.mechanism;
  for (ir::LeafValues<double>& state : states) {
    std::vector<double>& y = state[LeafKind::kPosition];
    for (const std::size_t q : model::lay_out_coordinates(mechanism).quaternions) {
      const double length = std::hypot(std::hypot(y[q], y[q + 1]), std::hypot(y[q + 2], y[q + 3]));
      for (std::size_t i = q; i < q + 4; ++i) y[i] /= length;
    }
    if (!subject.plan || !subject.plan->is_reduced()) continue;
    dynamics::DerivationOptions options;
    options.closures_only = true;
    const dynamics::Equations closures = dynamics::derive_equations(mechanism, options);
    const validate::ExactClosure closure(mechanism, closures, *subject.plan);
    ir::LeafValues<support::ScaledReal> exact;
    for (std::size_t k = 0; k < ir::kLeafKinds; ++k)
      exact.of[k].assign(state.of[k].begin(), state.of[k].end());
    state = validate::rounded(closure.closed(std::move(exact)));
  }
  return states;
}

}  // namespace jourdain::tests
