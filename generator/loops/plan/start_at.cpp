#include "loops/plan/start_at.hpp"

#include "dynamics/equations.hpp"
#include "loops/plan/states.hpp"
#include "loops/rows/configuration.hpp"

namespace jourdain::loops {

ConstraintPrograms closure_programs(const model::Mechanism& mechanism) {
  dynamics::DerivationOptions options;
  options.closures_only = options.for_derivatives = true;
  return constraint_programs(mechanism, dynamics::derive_equations(mechanism, options)).front();
}

std::optional<Start> start_of(const model::Mechanism& mechanism, const LoopPlan& plan,
                              support::Diagnostics& diagnostics) {
  const model::Mechanism held = without_states(mechanism);
  const ConstraintPrograms programs = closure_programs(held);
  NumericClosure closure(held, programs, model::default_values(held));
  constexpr long double kBranch = 100;  // times what was seen: further open there is another branch
  closure.disregard(plan.disagreeing, kBranch * plan.disagreement);
  std::vector<std::size_t> independent;
  for (const std::size_t k : plan.independent)
    if (k < closure.velocity_count()) independent.push_back(k);
  return find_start(held, closure, independent, diagnostics);
}

}  // namespace jourdain::loops
