#include "loops/plan/planned_start.hpp"

#include "loops/plan/bend_check.hpp"
#include "loops/plan/preferred.hpp"
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
  std::optional<Start> start = find_start_again(held, closure, named_independent(held), plan, diagnostics);
  if (!start || !check_bend(held, closure, start->configuration, start->z, plan.rows, diagnostics)) return {};
  return start;
}

}  // namespace jourdain::loops
