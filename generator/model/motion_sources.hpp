// What prescribed motions follow beside time and parameters: states, and inputs through the rates of those.
#pragma once

#include <set>

#include "model/expression_taylor.hpp"
#include "model/mechanism.hpp"

namespace jourdain::model {

/// The states that an expression names.
std::set<std::size_t> states_in(const Expression& expression);

/// States that a motion follows: it names the first; rates of those name the second, which its velocity is made of.
/// Its acceleration is made of the rates of the second.
struct MotionSources {
  std::set<std::size_t> first, second;
};
MotionSources motion_sources(const Mechanism& mechanism, const Expression& motion);

/// Some prescribed motion follows states.
bool motions_follow_states(const Mechanism& mechanism);

/// Accelerations of prescribed motions depend on inputs.
bool motions_take_inputs(const Mechanism& mechanism);

/// Value, velocity and acceleration of a prescribed motion; `leaf` gives the value of a variable. States move by their
/// rates, inputs stand still.
template <class Scalar, class Leaf>
Taylor<Scalar> motion_taylor(const Expression& motion, const std::vector<StateVariable>& states,
                             std::span<const Scalar> parameters, const Leaf& leaf) {
  const auto along = [&](const Expression& expression, const auto& of_state) {
    return taylor_of<Scalar>(expression, parameters, [&](const Variable& v) -> Taylor<Scalar> {
      if (v.kind == Variable::Kind::kState) return of_state(v);
      return {leaf(v), Scalar(v.kind == Variable::Kind::kTime ? 1 : 0), Scalar(0)};
    });
  };
  const auto value = [&](const Expression& expression) {
    return expression.evaluate<Scalar>(
        parameters, [](double v) { return Scalar(v); }, leaf);
  };
  const auto at_rate = [&](const Variable& v) -> Taylor<Scalar> {  // its own rate's rate is not asked for
    return {leaf(v), value(states[v.index].rate), Scalar(0)};
  };
  return along(motion, [&](const Variable& v) -> Taylor<Scalar> {
    const Taylor<Scalar> rate = along(states[v.index].rate, at_rate);
    return {leaf(v), rate.value, rate.first};
  });
}

/// At t = 0 with the initial values of the states, inputs zero.
Taylor<double> motion_at_start(const Expression& motion, const std::vector<StateVariable>& states,
                               const std::vector<double>& parameters);

}  // namespace jourdain::model
