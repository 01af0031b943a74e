#include "commands/memory_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "programs/steppers.hpp"

namespace jourdain::commands {

std::string check_multistep(const std::vector<std::string>& functions, const model::Mechanism& mechanism) {
  if (!has_samples(mechanism)) return "";
  for (const std::string& function : functions) {
    const programs::Stepper* stepper = programs::find_stepper(function.substr(0, function.rfind("_step")));
    if (stepper && stepper->history > 0)
      return fmt::format(
          "{} goes on with rates of earlier steps, and '{}' has memories, at whose samples rates jump; "
          "take a method of one step",
          stepper->name, mechanism.name);
  }
  return "";
}

bool samples_at_steps(const model::Mechanism& mechanism) {
  const auto waits = [&](const model::Expression::Node& node) {  // for a sample to be due
    return node.op == model::Expression::Op::kVariable &&
           node.variable.kind == model::Variable::Kind::kState &&
           mechanism.states[node.variable.index].period;
  };
  return std::any_of(
      mechanism.states.begin(), mechanism.states.end(), [&](const model::StateVariable& state) {
        return state.sampled && !state.period &&
               std::none_of(state.sampled->nodes().begin(), state.sampled->nodes().end(), waits);
      });
}

std::string check_sampling(const model::Mechanism& mechanism, const std::vector<double>& parameters,
                           double h) {
  constexpr double kRounding = 1e-6;  // of a step
  for (const model::StateVariable& state : mechanism.states) {
    if (!state.period) continue;
    const double period = state.period->evaluate<double>(parameters), steps = period / h;
    if (period == 0) continue;  // a sample at every step
    if (!(std::round(steps) >= 1 && std::fabs(steps - std::round(steps)) <= kRounding * steps))
      return fmt::format(
          "{} has a period of {:g} s, which is {:g} steps of {:g} s: a whole number is needed, or samples "
          "are not evenly spaced",
          state.name, period, steps, h);
  }
  return "";
}

std::string check_drawn_sampling(const model::Mechanism& mechanism, const std::vector<double>& parameters,
                                 std::size_t entry, double width) {
  std::vector<double> drawn = parameters;
  drawn[entry] += width;
  for (const model::StateVariable& state : mechanism.states)
    if (state.period && state.period->evaluate<double>(parameters) != state.period->evaluate<double>(drawn))
      return fmt::format(
          "the period of {} follows from '{}': as it is drawn it is no whole number of steps, and samples "
          "are not evenly spaced",
          state.name, mechanism.parameters[entry].name);
  return "";
}

}  // namespace jourdain::commands
