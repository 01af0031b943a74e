#include "model/read/input_numbers.hpp"

#include <optional>
#include <vector>

namespace jourdain::model {

void for_general_expressions(Mechanism& mechanism, const std::function<void(Expression&)>& change) {
  for_each_force_element(mechanism, [&](auto& element) {
    for (Expression* expression : element.expressions()) change(*expression);
  });
  for (Output& output : mechanism.outputs) change(output.value);
  for (Loop& loop : mechanism.loops) change(loop.residual);
}

void replace_inputs(Mechanism& mechanism, const std::function<Expression(std::size_t)>& replacement) {
  for_general_expressions(mechanism, [&](Expression& expression) {
    expression = expression.substituted([&](const Variable& variable) {
      return variable.kind == Variable::Kind::kInput ? replacement(variable.index)
                                                     : Expression::variable(variable);
    });
  });
}

void add_actuator(Mechanism& mechanism, const Actuator& actuator) {
  const std::size_t count = mechanism.actuators.size();
  if (!mechanism.inputs.empty())
    replace_inputs(mechanism, [count](std::size_t input) {
      return Expression::variable({Variable::Kind::kInput, input < count ? input : input + 1, 0});
    });
  mechanism.actuators.push_back(actuator);
}

void remove_actuators(Mechanism& mechanism, const std::function<bool(const Actuator&)>& goes) {
  std::vector<std::optional<std::size_t>> input;  // new index of each input
  std::size_t kept = 0;
  for (const Actuator& actuator : mechanism.actuators)
    input.push_back(goes(actuator) ? std::nullopt : std::optional(kept++));
  for (std::size_t i = 0; i < mechanism.inputs.size(); ++i) input.emplace_back(kept++);
  std::erase_if(mechanism.actuators, goes);
  replace_inputs(mechanism, [&input](std::size_t i) {
    return input[i] ? Expression::variable({Variable::Kind::kInput, *input[i], 0}) : Expression(0.0);
  });
}

}  // namespace jourdain::model
