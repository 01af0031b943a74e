#include "model/read/input_numbers.hpp"

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
  const std::size_t count = mechanism.actuators.size();
  std::vector<bool> is_named(count, false);
  for_general_expressions(mechanism, [&](Expression& expression) {
    any_variable(expression, [&](const Variable& variable) {
      if (variable.kind == Variable::Kind::kInput && variable.index < count) is_named[variable.index] = true;
      return false;
    });
  });
  std::vector<std::size_t> kept, named;
  std::vector<Input> still;
  for (std::size_t i = 0; i < count; ++i) {
    const Actuator& actuator = mechanism.actuators[i];
    if (!goes(actuator)) {
      kept.push_back(i);
    } else if (is_named[i]) {
      named.push_back(i);
      still.push_back({actuator.name, "", "", actuator.where});
    }
  }
  std::vector<std::size_t> number(count + mechanism.inputs.size(), 0);  // new, of each input that is named
  for (std::size_t i = 0; i < kept.size(); ++i) number[kept[i]] = i;
  for (std::size_t i = 0; i < named.size(); ++i) number[named[i]] = kept.size() + i;
  for (std::size_t i = 0; i < mechanism.inputs.size(); ++i)
    number[count + i] = kept.size() + named.size() + i;
  std::erase_if(mechanism.actuators, goes);
  mechanism.inputs.insert(mechanism.inputs.begin(), still.begin(), still.end());
  replace_inputs(mechanism, [&number](std::size_t i) {
    return Expression::variable({Variable::Kind::kInput, number[i], 0});
  });
}

}  // namespace jourdain::model
