#include "loops/plan/states.hpp"

#include <utility>
#include <vector>

#include "model/expression_sums.hpp"
#include "model/motion_sources.hpp"

namespace jourdain::loops {

namespace {

/// What a motion that follows states does from t = 0 on, at the parameters' default values, inputs zero; from rest it
/// moves off at 1 rad/s² or m/s²: where it stands at the start says little of where it goes.
model::Expression as_it_starts(const model::Expression& motion,
                               const std::vector<model::StateVariable>& states,
                               const std::vector<double>& parameters) {
  const model::Taylor<double> at = model::motion_at_start(motion, states, parameters);
  const bool rests = at.first == 0 && at.second == 0;
  const model::Expression t = model::Expression::variable({model::Variable::Kind::kTime});
  return model::plus(at.value,
                     model::times(t, model::plus(at.first, model::times(rests ? 0.5 : at.second / 2, t))));
}

}  // namespace

model::Mechanism without_states(model::Mechanism mechanism) {
  const std::vector<model::StateVariable> states = std::move(mechanism.states);
  mechanism.states.clear();
  const auto hold = [&states](model::Expression& expression) {
    expression = expression.substituted([&states](const model::Variable& variable) {
      return variable.kind == model::Variable::Kind::kState ? states[variable.index].initial
                                                            : model::Expression::variable(variable);
    });
  };
  const std::vector<double> parameters = model::default_values(mechanism);
  if (model::motions_follow_states(mechanism))  // what is proven is so for ranges of time
    mechanism.loop_options.treatment = model::LoopTreatment::kMultipliers;
  for (model::Joint& joint : mechanism.joints)
    for (model::Coordinate& coordinate : joint.coordinates)
      if (coordinate.motion && !model::states_in(*coordinate.motion).empty())
        coordinate.motion = as_it_starts(*coordinate.motion, states, parameters);
  for_each_force_element(mechanism, [&hold](auto& element) {
    for (model::Expression* expression : element.expressions()) hold(*expression);
  });
  for (model::Output& output : mechanism.outputs) hold(output.value);
  return mechanism;
}

void add_states(const model::Mechanism& mechanism, LoopPlan& plan) {
  const std::vector<double> parameters = model::default_values(mechanism);
  if (plan.reason.empty() && model::motions_follow_states(mechanism)) plan.reason = "motions follow states";
  for (const model::StateVariable& state : mechanism.states) {
    if (plan.is_reduced()) plan.independent.push_back(plan.z.size());
    plan.z.push_back(state.initial.evaluate<double>(parameters));
    plan.kept_z.push_back(true);
  }
}

}  // namespace jourdain::loops
