#include "loops/plan/states.hpp"

#include <utility>
#include <vector>

namespace jourdain::loops {

model::Mechanism without_states(model::Mechanism mechanism) {
  const std::vector<model::StateVariable> states = std::move(mechanism.states);
  mechanism.states.clear();
  const auto hold = [&states](model::Expression& expression) {
    expression = expression.substituted([&states](const model::Variable& variable) {
      return variable.kind == model::Variable::Kind::kState ? states[variable.index].initial
                                                            : model::Expression::variable(variable);
    });
  };
  for_each_force_element(mechanism, [&hold](auto& element) {
    for (model::Expression* expression : element.expressions()) hold(*expression);
  });
  for (model::Output& output : mechanism.outputs) hold(output.value);
  return mechanism;
}

void add_states(const model::Mechanism& mechanism, LoopPlan& plan) {
  const std::vector<double> parameters = model::default_values(mechanism);
  for (const model::StateVariable& state : mechanism.states) {
    if (plan.is_reduced()) plan.independent.push_back(plan.z.size());
    plan.z.push_back(state.initial.evaluate<double>(parameters));
  }
}

}  // namespace jourdain::loops
