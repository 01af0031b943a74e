// Implementation of Reference: applied forces. For minimal.cpp only.
#pragma once

#include "reference/frame_motion.hpp"

namespace jourdain::reference {

/// A state with everything that forces depend on.
template <class Scalar>
struct Reference<Scalar>::Forces {
  const State<Scalar> state;  // with its inputs
  std::vector<FrameMotion> bodies, frames;
  VectorX<Scalar> rates;  // of all columns, prescribed ones too
  Scalar h = 0;           // of the step that begins; of samples

  /// Component of a frame's velocity in the inertial frame.
  Bounded<Scalar> velocity(std::size_t frame, Eigen::Index component) const {
    const FrameMotion& f = frames[frame];
    return {f.J_t.row(component).dot(rates), f.J_t_scale.row(component).dot(rates.cwiseAbs())};
  }
};

template <class Scalar>
Bounded<Scalar> Reference<Scalar>::general(const model::Expression& expression, const Forces& at) const {
  using Kind = model::Variable::Kind;
  const auto variable = [&](const model::Variable& v) -> Bounded<Scalar> {
    const auto k = Eigen::Index(v.component);
    switch (v.kind) {
      case Kind::kTime:
        return at.state.t;
      case Kind::kPosition:
        return coordinate(v.index, v.component, at.state).value;
      case Kind::kVelocity:
        return coordinate(v.index, v.component, at.state).first;
      case Kind::kInput:
        return at.state.u[Eigen::Index(v.index)];
      case Kind::kStepLength:
        return at.h;
      case Kind::kState:
        return at.state.z[Eigen::Index(layout_.first_state() + v.index)];
      case Kind::kFramePosition:
        return {at.frames[v.index].p[k], at.frames[v.index].p_scale[k]};
      case Kind::kFrameVelocity:
        return at.velocity(v.index, k);
      case Kind::kFrameSpin: {
        const FrameMotion& f = at.frames[v.index];
        return {f.R.col(k).dot(f.omega), f.R.col(k).cwiseAbs().dot(f.omega_scale)};
      }
      case Kind::kFrameWorldSpin:
        return {at.frames[v.index].omega[k], at.frames[v.index].omega_scale[k]};
      case Kind::kFrameDirection:
        return {at.frames[v.index].R(k / 3, k % 3), Scalar(1)};
      case Kind::kArgument:
        break;
    }
    throw support::InternalError("an argument outside its function");
  };
  std::vector<Bounded<Scalar>> parameters(parameters_.begin(), parameters_.end());
  return expression.evaluate<Bounded<Scalar>>(
      parameters, [](double v) { return Bounded<Scalar>(Scalar(v)); }, variable);
}

/// Joint springs, dampers and friction, and what rotors add to inertia.
template <class Scalar>
void Reference<Scalar>::add_joint_forces(const Forces& at, Terms<Scalar>& sum) const {
  const auto push = [&](Eigen::Index column, const Bounded<Scalar>& force) {
    sum.q_bar[column] -= force.value;
    sum.q_scale[column] += force.scale;
  };
  for (std::size_t j = 0; j < mechanism_.joints.size(); ++j) {
    const model::Joint& joint = mechanism_.joints[j];
    for (std::size_t c = 0; c < joint.coordinates.size(); ++c) {
      const model::Coordinate& element = joint.coordinates[c];
      const Taylor<Scalar> q = coordinate(j, c, at.state);
      const Bounded<Scalar> rate = q.first, stiffness = value(element.stiffness);
      const Bounded<Scalar> stretch = Bounded<Scalar>(q.value) - Bounded<Scalar>(value(element.rest));
      const Eigen::Index column = column_of(j, c);
      push(column, -(stiffness * stretch) - Bounded<Scalar>(value(element.damping)) * rate);
      if (!element.friction.is_zero()) {
        const Bounded<Scalar> speed = value(element.friction_speed);
        push(column, -(Bounded<Scalar>(value(element.friction)) * rate / sqrt(rate * rate + speed * speed)));
      }
      const Bounded<Scalar> energy = stiffness * stretch * stretch / Bounded<Scalar>(2);
      sum.potential_energy += energy.value;
      sum.potential_scale += energy.scale;
    }
    if (joint.type != model::JointType::kSpherical) continue;
    const auto first = Eigen::Index(layout_.joints[j].first_velocity);
    for (Eigen::Index k = first; k < first + 3; ++k)
      push(k, -(Bounded<Scalar>(value(joint.spin_damping)) * Bounded<Scalar>(at.state.z[k])));
  }
  for (const model::Actuator& actuator : mechanism_.actuators) {
    const Eigen::Index column = column_of(actuator.joint.value, actuator.coordinate);
    const Scalar gear = value(actuator.gear_ratio), inertia = gear * gear * value(actuator.rotor_inertia);
    sum.M(column, column) += inertia;
    sum.M_scale(column, column) += inertia;
    sum.kinetic_energy += inertia * at.rates[column] * at.rates[column] / 2;
    sum.kinetic_scale += inertia * at.rates[column] * at.rates[column] / 2;
  }
}

}  // namespace jourdain::reference
