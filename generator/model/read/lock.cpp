#include "model/read/lock.hpp"

#include <optional>
#include <vector>

#include "model/output_kinds.hpp"

namespace jourdain::model {

namespace {

/// Calls `change` with each expression that may name coordinates and inputs.
template <class Change>
void for_general_expressions(Mechanism& mechanism, Change&& change) {
  for_each_force_element(mechanism, [&](auto& element) {
    for (Expression* expression : element.expressions()) change(*expression);
  });
  for (Output& output : mechanism.outputs) change(output.value);
  for (Loop& loop : mechanism.loops) change(loop.residual);
}

/// Is it a residual of that joint's coordinates alone?
bool is_about(const Loop& loop, JointIndex joint) {
  const auto of_joint = [joint](const Variable& v) {
    return v.kind == Variable::Kind::kPosition && v.index == joint.value;
  };
  return any_variable(loop.residual, of_joint) &&
         !any_variable(loop.residual, [&](const Variable& v) { return !of_joint(v); });
}

}  // namespace

void lock(Mechanism& mechanism, JointIndex joint) {
  std::erase_if(mechanism.loops, [joint](const Loop& loop) { return is_about(loop, joint); });
  mechanism.joints[joint.value].set_type(JointType::kFixed);
  const auto on_joint = [joint](const auto& element) { return element.joint == joint; };
  std::vector<std::optional<std::size_t>> input;  // new index of each input
  std::size_t kept = 0;
  for (const Actuator& actuator : mechanism.actuators)
    input.push_back(on_joint(actuator) ? std::nullopt : std::optional(kept++));
  for (std::size_t i = 0; i < mechanism.inputs.size(); ++i) input.emplace_back(kept++);
  for_each_force_list(mechanism, [&](auto& list) {
    std::erase_if(list, [&](const auto& element) { return element.pushed() && on_joint(*element.pushed()); });
  });
  std::erase_if(mechanism.loop_options.independent, on_joint);
  std::erase_if(mechanism.outputs, [&](const Output& output) {
    return output_kind(output.kind).subject == OutputSubject::kCoordinate && output.joint == joint;
  });
  for_general_expressions(mechanism, [&](Expression& expression) {
    expression = expression.substituted([&](const Variable& variable) {
      using Kind = Variable::Kind;
      const bool coordinate = variable.kind == Kind::kPosition || variable.kind == Kind::kVelocity;
      if (coordinate && variable.index == joint.value) return Expression(0.0);
      if (variable.kind != Kind::kInput) return Expression::variable(variable);
      const std::optional<std::size_t> index = input[variable.index];
      return index ? Expression::variable({Kind::kInput, *index, 0}) : Expression(0.0);
    });
  });
}

}  // namespace jourdain::model
