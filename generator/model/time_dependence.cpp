#include "model/time_dependence.hpp"

#include <algorithm>

#include "model/motion_sources.hpp"
#include "model/output_kinds.hpp"

namespace jourdain::model {

namespace {

bool is_time(const Variable& variable) { return variable.kind == Variable::Kind::kTime; }

bool is_driven(const Coordinate& coordinate) {
  return coordinate.motion && any_variable(*coordinate.motion, is_time);
}

bool is_driven(const Joint& joint) {
  return std::any_of(joint.coordinates.begin(), joint.coordinates.end(),
                     [](const Coordinate& c) { return is_driven(c); });
}

/// Its position, velocity or acceleration at given states and inputs.
bool moves_with_time(const Mechanism& mechanism, const Joint& joint) {
  const auto rates_do = [&](const std::set<std::size_t>& states) {
    return std::ranges::any_of(
        states, [&](std::size_t state) { return any_variable(mechanism.states[state].rate, is_time); });
  };
  return is_driven(joint) || std::ranges::any_of(joint.coordinates, [&](const Coordinate& coordinate) {
           if (!coordinate.motion) return false;
           const MotionSources sources = motion_sources(mechanism, *coordinate.motion);
           return rates_do(sources.first) || rates_do(sources.second);
         });
}

bool positions_depend(const Mechanism& mechanism) {
  return std::any_of(mechanism.joints.begin(), mechanism.joints.end(),
                     [](const Joint& joint) { return is_driven(joint); }) ||
         std::any_of(mechanism.loops.begin(), mechanism.loops.end(), [](const Loop& loop) {
           return any_variable(loop.length, is_time) || any_variable(loop.residual, is_time);
         });
}

bool forces_depend(const Mechanism& mechanism) {
  return any_force_element(mechanism, [](const auto& element) { return any_variable(element, is_time); });
}

/// Outputs, given what positions and dynamics do.
class OutputTime {
 public:
  OutputTime(const Mechanism& mechanism, const TimeDependence& time)
      : mechanism_(mechanism),
        time_(time),
        moves_(time.positions || std::ranges::any_of(mechanism.joints, [&](const Joint& joint) {
                 return moves_with_time(mechanism, joint);
               })) {}

  bool depends(const Output& output) const {
    switch (output_kind(output.kind).clock) {
      case OutputClock::kFrame:
        return frame_depends(output.frame);
      case OutputClock::kPositions:
        return moves_;
      case OutputClock::kDynamics:
        return time_.dynamics;
      case OutputClock::kValue:
        return any_variable(output.value, [this](const Variable& v) { return depends(v); });
    }
    return true;
  }

 private:
  bool depends(const Variable& variable) const {
    switch (variable.kind) {
      case Variable::Kind::kTime:
        return true;
      case Variable::Kind::kPosition:
      case Variable::Kind::kVelocity:
        return joint_depends(mechanism_.joints[variable.index]);
      case Variable::Kind::kFramePosition:
      case Variable::Kind::kFrameVelocity:
      case Variable::Kind::kFrameSpin:
      case Variable::Kind::kFrameWorldSpin:
      case Variable::Kind::kFrameDirection:
        return frame_depends(FrameIndex(variable.index));
      case Variable::Kind::kInput:
      case Variable::Kind::kState:
      case Variable::Kind::kStepLength:
      case Variable::Kind::kArgument:
        return false;
    }
    return true;
  }

  /// Loops carry what moves with time to all coordinates that they determine.
  bool joint_depends(const Joint& joint) const {
    return mechanism_.loops.empty() ? moves_with_time(mechanism_, joint) : moves_;
  }

  bool frame_depends(FrameIndex frame) const {
    std::optional<BodyIndex> body = mechanism_.frames[frame.value].body;
    if (!body || !time_.drift) return false;
    while (body) {
      const auto joint = std::find_if(mechanism_.joints.begin(), mechanism_.joints.end(),
                                      [&](const Joint& j) { return j.child == *body; });
      if (joint == mechanism_.joints.end() || joint_depends(*joint)) return true;
      body = joint->parent;
    }
    return false;
  }

  const Mechanism& mechanism_;
  const TimeDependence& time_;
  bool moves_;  ///< some position, or velocity
};

}  // namespace

TimeDependence time_dependence(const Mechanism& mechanism) {
  TimeDependence time;
  time.positions = positions_depend(mechanism);
  time.drift = time.positions || motions_follow_states(mechanism);
  time.dynamics =
      time.positions || forces_depend(mechanism);  // states that motions follow are force elements
  const OutputTime outputs(mechanism, time);
  time.outputs = std::any_of(mechanism.outputs.begin(), mechanism.outputs.end(),
                             [&](const Output& output) { return outputs.depends(output); });
  return time;
}

}  // namespace jourdain::model
