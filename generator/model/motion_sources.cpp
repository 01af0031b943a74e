#include "model/motion_sources.hpp"

#include <algorithm>

namespace jourdain::model {

namespace {

template <class Holds>
bool any_motion(const Mechanism& mechanism, const Holds& holds) {
  for (const Joint& joint : mechanism.joints)
    for (const Coordinate& coordinate : joint.coordinates)
      if (coordinate.motion && holds(*coordinate.motion)) return true;
  return false;
}

}  // namespace

std::set<std::size_t> states_in(const Expression& expression) {
  std::set<std::size_t> states;
  for (const Expression::Node& node : expression.nodes())
    if (node.op == Expression::Op::kVariable && node.variable.kind == Variable::Kind::kState)
      states.insert(node.variable.index);
  return states;
}

MotionSources motion_sources(const Mechanism& mechanism, const Expression& motion) {
  MotionSources sources{states_in(motion), {}};
  for (const std::size_t state : sources.first) sources.second.merge(states_in(mechanism.states[state].rate));
  return sources;
}

bool motions_follow_states(const Mechanism& mechanism) {
  return any_motion(mechanism, [](const Expression& motion) { return !states_in(motion).empty(); });
}

bool motions_take_inputs(const Mechanism& mechanism) {
  return any_motion(mechanism, [&](const Expression& motion) {
    return std::ranges::any_of(motion_sources(mechanism, motion).second, [&](std::size_t state) {
      return any_variable(mechanism.states[state].rate,
                          [](const Variable& v) { return v.kind == Variable::Kind::kInput; });
    });
  });
}

Taylor<double> motion_at_start(const Expression& motion, const std::vector<StateVariable>& states,
                               const std::vector<double>& parameters) {
  return motion_taylor<double>(motion, states, parameters, [&](const Variable& v) {
    return v.kind == Variable::Kind::kState ? states[v.index].initial.evaluate<double>(parameters) : 0.0;
  });
}

}  // namespace jourdain::model
