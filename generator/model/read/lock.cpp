#include "model/read/lock.hpp"

#include <type_traits>

#include "model/output_kinds.hpp"
#include "model/read/input_numbers.hpp"

namespace jourdain::model {

namespace {

/// Is it an expression of that joint's coordinates alone?
bool is_about(const Loop& loop, JointIndex joint) {
  const auto of_joint = [joint](const Variable& v) {
    return (v.kind == Variable::Kind::kPosition || v.kind == Variable::Kind::kVelocity) &&
           v.index == joint.value;
  };
  return any_variable(loop.residual, of_joint) &&
         !any_variable(loop.residual, [&](const Variable& v) { return !of_joint(v); });
}

}  // namespace

void lock(Mechanism& mechanism, JointIndex joint) {
  std::erase_if(mechanism.loops, [joint](const Loop& loop) { return is_about(loop, joint); });
  mechanism.joints[joint.value].set_type(JointType::kFixed);
  const auto on_joint = [joint](const auto& element) { return element.joint == joint; };
  for_each_force_list(mechanism, [&](auto& list) {
    if constexpr (!std::is_same_v<decltype(list), std::vector<Actuator>&>)
      std::erase_if(list,
                    [&](const auto& element) { return element.pushed() && on_joint(*element.pushed()); });
  });
  remove_actuators(mechanism, on_joint);
  std::erase_if(mechanism.loop_options.independent, on_joint);
  std::erase_if(mechanism.outputs, [&](const Output& output) {
    return output_kind(output.kind).subject == OutputSubject::kCoordinate && output.joint == joint;
  });
  for_general_expressions(mechanism, [&](Expression& expression) {
    expression = expression.substituted([&](const Variable& variable) {
      using Kind = Variable::Kind;
      const bool coordinate = variable.kind == Kind::kPosition || variable.kind == Kind::kVelocity;
      return coordinate && variable.index == joint.value ? Expression(0.0) : Expression::variable(variable);
    });
  });
}

}  // namespace jourdain::model
