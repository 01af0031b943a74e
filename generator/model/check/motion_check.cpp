// Are prescribed motions known with their velocities and accelerations?
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "model/check/checks.hpp"
#include "model/hidden_kinks.hpp"
#include "model/loop_kinds.hpp"
#include "model/motion_sources.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;
using support::shown;
using Kind = Variable::Kind;

class MotionCheck {
 public:
  MotionCheck(const Mechanism& mechanism, Diagnostics& diagnostics)
      : mechanism_(mechanism), diagnostics_(diagnostics), parameters_(default_values(mechanism)) {}

  void run() {
    for (const Joint& joint : mechanism_.joints) {
      for (const Expression& component : joint.curve) calls(component, "curve", joint.name, joint.where);
      for (const Coordinate& coordinate : joint.coordinates)
        if (coordinate.motion) motion(coordinate);
    }
  }

 private:
  void motion(const Coordinate& coordinate) {
    const Expression& motion = *coordinate.motion;
    if (!calls(motion, "motion", coordinate.name, coordinate.motion_where)) return;
    const MotionSources sources = motion_sources(mechanism_, motion);
    if (sources.first.empty()) return;
    const LoopOptions& loops = mechanism_.loop_options;
    const bool reduces = loops.treatment && *loops.treatment != LoopTreatment::kMultipliers;
    if (!mechanism_.loops.empty() && (reduces || !loops.independent.empty()))
      return diagnostics_.error(
          loops.where,
          fmt::format("the motion of '{}' follows state '{}': loops are held by multipliers",
                      shown(coordinate.name), shown(mechanism_.states[*sources.first.begin()].name)),
          "other treatments need motions that are functions of t");
    for (const std::size_t i : sources.first) {
      const StateVariable& state = mechanism_.states[i];
      if (!follows(coordinate, i, true) || !calls(state.rate, "rate", state.name, state.where)) return;
    }
    for (const std::size_t state : sources.second)
      if (!sources.first.contains(state) && !follows(coordinate, state, false)) return;
    start(coordinate);
  }

  /// Loops are closed with numbers that follow from motions, their velocities and curves: those of what stands in for a
  /// function of the user say nothing.
  bool calls(const Expression& expression, const char* what, const std::string& name, SourceRange where) {
    if (mechanism_.loops.empty() || !expression.calls(support::Function::kCall)) return true;
    diagnostics_.error(where,
                       fmt::format("the {} of '{}' calls an external function beside {}", what, shown(name),
                                   in_words(mechanism_.loops.front())),
                       "where constraints hold, the compiler knows what moves coordinates");
    return false;
  }

  /// Whether the motion, or its velocity, may name the state; otherwise after a diagnostic.
  bool follows(const Coordinate& coordinate, std::size_t index, bool is_named) {
    const StateVariable& state = mechanism_.states[index];
    const char* const jumps = is_named ? "position" : "velocity";
    if (state.sampled)
      return refuse(
          coordinate, fmt::format("follows memory '{}'", shown(state.name)),
          fmt::format("its {} would jump at samples: a state that follows the memory does not", jumps));
    const auto names = [&](Kind kind) {
      return any_variable(state.rate, [kind](const Variable& v) { return v.kind == kind; });
    };
    const std::string follows = fmt::format("follows state '{}', whose rate ", shown(state.name));
    const bool is_known = !any_variable(state.rate, [](const Variable& v) {
      return v.kind != Kind::kTime && v.kind != Kind::kState && v.kind != Kind::kInput;
    });
    if (!is_known)
      return refuse(coordinate, follows + "depends on what the mechanism does",
                    "a motion is known beforehand: an actuator or a force answers to the mechanism");
    if (!is_named) return true;
    if (names(Kind::kInput))
      return refuse(
          coordinate, follows + "names an input",
          "its velocity would jump with the input: a second state between them, as in p' = v, v' = u");
    if (state.rate.has_kinks())
      return refuse(coordinate, follows + "may have a kink",
                    "its acceleration would jump; smooth_step, smooth_max and tanh have none");
    if (const std::optional<HiddenKink> kink = hidden_kink(state.rate, parameters_))
      return refuse(coordinate, follows + "may have a kink or a pole: " + in_words(*kink), hint_of(*kink));
    return true;
  }

  bool refuse(const Coordinate& coordinate, const std::string& why, const std::string& hint) {
    diagnostics_.error(coordinate.motion_where,
                       fmt::format("the motion of '{}' {}", shown(coordinate.name), why), hint);
    return false;
  }

  void start(const Coordinate& coordinate) {
    const Taylor<double> at = motion_at_start(*coordinate.motion, mechanism_.states, parameters_);
    const char* const what = !std::isfinite(at.value)    ? "position"
                             : !std::isfinite(at.first)  ? "velocity"
                             : !std::isfinite(at.second) ? "acceleration"
                                                         : nullptr;
    if (what)
      refuse(coordinate, fmt::format("starts with a {} that is not finite", what),
             "at t = 0, with the initial values of states and inputs zero");
  }

  const Mechanism& mechanism_;
  Diagnostics& diagnostics_;
  std::vector<double> parameters_;
};

}  // namespace

void check_motions(const Mechanism& mechanism, Diagnostics& diagnostics) {
  MotionCheck(mechanism, diagnostics).run();
}

}  // namespace jourdain::model
