#include "loops/plan/planned_start.hpp"

#include "loops/plan/states.hpp"
#include "loops/rows/configuration.hpp"
#include "loops/rows/constraints.hpp"

namespace jourdain::loops {

std::optional<Start> planned_start(const model::Mechanism& mechanism, const LoopPlan& plan,
                                   support::Diagnostics& diagnostics) {
  const model::Mechanism held = without_states(mechanism);
  const ConstraintPrograms programs = closure_programs(held);
  NumericClosure closure(held, programs, model::default_values(held));
  closure.disregard(plan.disagreeing, plan.tolerated_disagreement());
  std::vector<std::size_t> independent;
  for (const std::size_t k : plan.independent)
    if (k < closure.velocity_count()) independent.push_back(k);  // not of states
  return find_start(held, closure, independent, diagnostics, plan.starts_beside ? &plan.y : nullptr);
}

}  // namespace jourdain::loops
