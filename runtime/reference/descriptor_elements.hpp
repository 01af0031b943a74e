// Force elements of the descriptor form: what each kind does to bodies and coordinates. For descriptor_forces.cpp only.
#pragma once

#include <Eigen/Dense>

#include <cmath>
#include <span>
#include <vector>

#include "reference/descriptor_forces.hpp"
#include "support/check.hpp"

namespace jourdain::reference::descriptor {

/// Value at the scene's state; `arguments` are what the expression is a function of.
template <class Scalar>
Scalar value(const model::Expression& expression, const Scene<Scalar>& scene,
             std::span<const Scalar> arguments = {}) {
  using model::Variable;
  const auto variable = [&](const Variable& v) -> Scalar {
    const auto i = v.index;
    const auto component = Eigen::Index(v.component);
    switch (v.kind) {
      case Variable::Kind::kTime:
        return scene.t;
      case Variable::Kind::kPosition:
        return scene.position.at(i).at(v.component);
      case Variable::Kind::kVelocity:
        return scene.rate.at(i).at(v.component);
      case Variable::Kind::kInput:
        return scene.inputs.at(i);
      case Variable::Kind::kFramePosition:
        return scene.frames.at(i).p_WF[component];
      case Variable::Kind::kFrameVelocity:
        return scene.frames.at(i).v_F[component];
      case Variable::Kind::kFrameSpin:
        return scene.frames.at(i).omega[component];
      case Variable::Kind::kFrameWorldSpin:
        return scene.frames.at(i).R_WF.row(component).dot(scene.frames.at(i).omega);
      case Variable::Kind::kFrameDirection:
        return scene.frames.at(i).R_WF(component / 3, component % 3);
      case Variable::Kind::kState:
        return scene.states.at(i);
      case Variable::Kind::kStepLength:
        return scene.h;
      case Variable::Kind::kArgument:
        JD_CHECK(v.component < arguments.size(), "argument {} of {}", v.component, arguments.size());
        return arguments[v.component];
    }
    throw support::InternalError("a variable is of no known kind");
  };
  return expression.evaluate<Scalar>(
      scene.parameters, [](double literal) { return Scalar(literal); }, variable);
}

template <class Scalar>
Vector3<Scalar> value(const model::Vector3& vector, const Scene<Scalar>& scene) {
  return {value(vector[0], scene), value(vector[1], scene), value(vector[2], scene)};
}

/// What one force element does.
template <class Scalar>
struct Effect {
  /// At the frame's origin, inertial components, N and N m.
  struct AtFrame {
    model::FrameIndex frame;
    Vector3<Scalar> force, moment = Vector3<Scalar>::Zero();
  };
  struct OnCoordinate {
    model::ScalarCoordinate at;
    Scalar force = 0;  ///< positive pushes forward
  };
  std::vector<AtFrame> at_frames = {};
  std::vector<OnCoordinate> on_coordinates = {};
};

template <class Scalar>
Effect<Scalar> effect(const model::Actuator& actuator, const model::Mechanism& mechanism,
                      const Scene<Scalar>& scene) {
  const auto input = std::size_t(&actuator - mechanism.actuators.data());
  return {.on_coordinates = {{*actuator.pushed(), value(actuator.gear_ratio, scene) * scene.inputs[input]}}};
}

template <class Scalar>
Effect<Scalar> effect(const model::CoordinateForce& force, const model::Mechanism&,
                      const Scene<Scalar>& scene) {
  return {.on_coordinates = {{*force.pushed(), value(force.force, scene)}}};
}

template <class Scalar>
Effect<Scalar> effect(const model::Load& load, const model::Mechanism&, const Scene<Scalar>& scene) {
  const Matrix3<Scalar> R_WL = load.axes == model::LoadAxes::kFrame ? scene.frames[load.frame.value].R_WF
                                                                    : Matrix3<Scalar>::Identity();
  return {.at_frames = {{load.frame, R_WL * value(load.force, scene), R_WL * value(load.moment, scene)}}};
}

/// Nothing on bodies and coordinates: see `state_rates`.
template <class Scalar>
Effect<Scalar> effect(const model::StateVariable&, const model::Mechanism&, const Scene<Scalar>&) {
  return {};
}

template <class Scalar>
Effect<Scalar> effect(const model::Spring& spring, const model::Mechanism&, const Scene<Scalar>& scene) {
  using std::sqrt;
  const FrameMotion<Scalar>& from = scene.frames[spring.from.value];
  const FrameMotion<Scalar>& to = scene.frames[spring.to.value];
  const Vector3<Scalar> delta = to.p_WF - from.p_WF;
  const auto smoothing = Scalar(model::kLengthSmoothing);
  const Scalar length = sqrt(delta.squaredNorm() + smoothing * smoothing);
  const Vector3<Scalar> direction = delta / length;
  const Scalar rate = direction.dot(to.v_F - from.v_F);
  const Scalar arguments[] = {length, rate};
  const Scalar tension = value(spring.stiffness, scene) * (length - value(spring.free_length, scene)) +
                         value(spring.damping, scene) * rate +
                         value(spring.law, scene, std::span<const Scalar>(arguments));
  const Vector3<Scalar> pull = tension * direction;
  return {.at_frames = {{spring.from, pull}, {spring.to, -pull}}};
}

}  // namespace jourdain::reference::descriptor
