// Implementation of Reference: what each kind of force element does. For minimal.cpp only.
#pragma once

#include "reference/minimal_forces.hpp"

namespace jourdain::reference {

/// What one force element does at a state: the same for the equations, their energy and the reactions of joints.
template <class Scalar>
struct Reference<Scalar>::Effect {
  using Components = std::array<Bounded<Scalar>, 3>;

  /// At the frame's origin, inertial components, N and N m.
  struct AtFrame {
    model::FrameIndex frame;
    Components force = {}, moment = {};
  };
  struct OnColumn {
    Eigen::Index column = 0;
    Bounded<Scalar> force;  ///< positive pushes forward
  };
  std::vector<AtFrame> at_frames = {};
  std::vector<OnColumn> on_columns = {};
  Bounded<Scalar> energy = {};  ///< J

  static Components negative(const Components& v) { return {-v[0], -v[1], -v[2]}; }

  /// Components in the inertial frame of a vector given in the axes of R.
  static Components turned(const Matrix3<Scalar>& R, const Components& v) {
    Components result;
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j)
        result[std::size_t(i)] = result[std::size_t(i)] + Bounded<Scalar>(R(i, j)) * v[std::size_t(j)];
    return result;
  }
};

template <class Scalar>
void Reference<Scalar>::add(const Effect& effect, const Forces& at, Terms<Scalar>& sum) const {
  for (const auto& [column, force] : effect.on_columns) {
    sum.q_bar[column] -= force.value;
    sum.q_scale[column] += force.scale;
  }
  for (const auto& [index, force, moment] : effect.at_frames) {
    const FrameMotion& frame = at.frames[index.value];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = Eigen::Index(k);
      sum.q_bar -= frame.J_t.row(row).transpose() * force[k].value;
      sum.q_scale += frame.J_t_scale.row(row).transpose() * force[k].scale;
      sum.q_bar -= frame.J_r.row(row).transpose() * moment[k].value;
      sum.q_scale += frame.J_r_scale.row(row).transpose() * moment[k].scale;
    }
  }
  sum.potential_energy += effect.energy.value;
  sum.potential_scale += effect.energy.scale;
}

template <class Scalar>
auto Reference<Scalar>::effect(const model::Actuator& actuator, const Forces& at) const -> Effect {
  const auto input = Eigen::Index(&actuator - mechanism_.actuators.data());
  const Bounded<Scalar> push =
      Bounded<Scalar>(value(actuator.gear_ratio)) * Bounded<Scalar>(at.state.u[input]);
  return {.on_columns = {{column_of(actuator.joint.value, actuator.coordinate), push}}};
}

template <class Scalar>
auto Reference<Scalar>::effect(const model::CoordinateForce& force, const Forces& at) const -> Effect {
  return {.on_columns = {{column_of(force.joint.value, force.coordinate), general(force.force, at)}}};
}

template <class Scalar>
auto Reference<Scalar>::effect(const model::Spring& spring, const Forces& at) const -> Effect {
  using B = Bounded<Scalar>;
  const FrameMotion &from = at.frames[spring.from.value], &to = at.frames[spring.to.value];
  const B smoothing = Scalar(model::kLengthSmoothing);
  B square = smoothing * smoothing, along;
  std::array<B, 3> difference;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = Eigen::Index(k);
    difference[k] = B(to.p[i], to.p_scale[i]) - B(from.p[i], from.p_scale[i]);
    square = square + difference[k] * difference[k];
    along = along + difference[k] * (at.velocity(spring.to.value, i) - at.velocity(spring.from.value, i));
  }
  const B length = sqrt(square), rate = along / length;
  const std::vector<B> parameters(parameters_.begin(), parameters_.end());
  const auto law = [&](const model::Expression& expression) {
    return expression.evaluate<B>(
        parameters, [](double v) { return B(Scalar(v)); },
        [&](const model::Variable& v) { return v.component == 0 ? length : rate; });
  };
  const B stretch = length - B(value(spring.free_length));
  const B tension = B(value(spring.stiffness)) * stretch + B(value(spring.damping)) * rate + law(spring.law);
  B energy = B(value(spring.stiffness)) * stretch * stretch / B(2);
  if (spring.potential) energy = energy + law(*spring.potential);
  const B share = tension / length;
  const std::array<B, 3> pull = {share * difference[0], share * difference[1], share * difference[2]};
  return {.at_frames = {{spring.from, pull}, {spring.to, Effect::negative(pull)}}, .energy = energy};
}

template <class Scalar>
auto Reference<Scalar>::effect(const model::Load& load, const Forces& at) const -> Effect {
  std::array<Bounded<Scalar>, 3> force, moment;
  for (std::size_t k = 0; k < 3; ++k) {
    force[k] = general(load.force[k], at);
    moment[k] = general(load.moment[k], at);
  }
  if (load.axes == model::LoadAxes::kFrame) {
    const Matrix3<Scalar>& R = at.frames[load.frame.value].R;
    force = Effect::turned(R, force);
    moment = Effect::turned(R, moment);
  }
  return {.at_frames = {{load.frame, force, moment}}};
}

template <class Scalar>
auto Reference<Scalar>::effect(const model::StateVariable& state, const Forces& at) const -> Effect {
  const auto index = std::size_t(&state - mechanism_.states.data());
  return {.on_columns = {{Eigen::Index(layout_.first_state() + index), general(state.rate, at)}}};
}

}  // namespace jourdain::reference
