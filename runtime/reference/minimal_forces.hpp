// Implementation of Reference: applied forces. For minimal.cpp only.
#pragma once

#include "reference/frame_motion.hpp"

namespace jourdain::reference {

/// A state with everything that forces depend on.
template <class Scalar>
struct Reference<Scalar>::Forces {
  const State<Scalar>& state;
  const VectorX<Scalar>& u;
  std::vector<FrameMotion> bodies, frames;
  VectorX<Scalar> rates;  // of all columns, prescribed ones too

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
        return at.u[Eigen::Index(v.index)];
      case Kind::kFramePosition:
        return {at.frames[v.index].p[k], at.frames[v.index].p_scale[k]};
      case Kind::kFrameVelocity:
        return at.velocity(v.index, k);
      case Kind::kFrameSpin: {
        const FrameMotion& f = at.frames[v.index];
        return {f.R.col(k).dot(f.omega), f.R.col(k).cwiseAbs().dot(f.omega_scale)};
      }
      case Kind::kArgument:
        break;
    }
    throw support::InternalError("an argument outside its function");
  };
  std::vector<Bounded<Scalar>> parameters(parameters_.begin(), parameters_.end());
  return expression.evaluate<Bounded<Scalar>>(
      parameters, [](double v) { return Bounded<Scalar>(Scalar(v)); }, variable);
}

namespace detail {

/// A force at the origin of a frame; positive pushes along the frame's columns.
template <class Scalar, class Frame>
void push(const Frame& frame, const std::array<Bounded<Scalar>, 3>& force, Scalar sign, Terms<Scalar>& sum) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    sum.q_bar -= sign * frame.J_t.row(k).transpose() * force[std::size_t(k)].value;
    sum.q_scale += frame.J_t_scale.row(k).transpose() * force[std::size_t(k)].scale;
  }
}

template <class Scalar, class Frame>
void turn(const Frame& frame, const std::array<Bounded<Scalar>, 3>& moment, Terms<Scalar>& sum) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    sum.q_bar -= frame.J_r.row(k).transpose() * moment[std::size_t(k)].value;
    sum.q_scale += frame.J_r_scale.row(k).transpose() * moment[std::size_t(k)].scale;
  }
}

/// Components in the inertial frame of a vector given in the axes of R.
template <class Scalar>
std::array<Bounded<Scalar>, 3> turned(const Matrix3<Scalar>& R, const std::array<Bounded<Scalar>, 3>& v) {
  std::array<Bounded<Scalar>, 3> result;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      result[std::size_t(i)] = result[std::size_t(i)] + Bounded<Scalar>(R(i, j)) * v[std::size_t(j)];
  return result;
}

}  // namespace detail

/// Joint springs, dampers and friction, rotors, actuators and forces on coordinates.
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
  for (std::size_t a = 0; a < mechanism_.actuators.size(); ++a) {
    const model::Actuator& actuator = mechanism_.actuators[a];
    const Eigen::Index column = column_of(actuator.joint.value, actuator.coordinate);
    const Scalar gear = value(actuator.gear_ratio), inertia = gear * gear * value(actuator.rotor_inertia);
    push(column, Bounded<Scalar>(gear) * Bounded<Scalar>(at.u[Eigen::Index(a)]));
    sum.M(column, column) += inertia;
    sum.M_scale(column, column) += inertia;
    sum.kinetic_energy += inertia * at.rates[column] * at.rates[column] / 2;
    sum.kinetic_scale += inertia * at.rates[column] * at.rates[column] / 2;
  }
  for (const model::CoordinateForce& force : mechanism_.coordinate_forces)
    push(column_of(force.joint.value, force.coordinate), general(force.force, at));
}

/// Force on the spring's `from` end, inertial components; its energy is added to `energy`.
template <class Scalar>
std::array<Bounded<Scalar>, 3> Reference<Scalar>::pull(const model::Spring& spring, const Forces& at,
                                                       Terms<Scalar>* energy) const {
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
  if (energy) {
    B stored = B(value(spring.stiffness)) * stretch * stretch / B(2);
    if (spring.potential) stored = stored + law(*spring.potential);
    energy->potential_energy += stored.value;
    energy->potential_scale += stored.scale;
  }
  const B share = tension / length;
  return {share * difference[0], share * difference[1], share * difference[2]};
}

template <class Scalar>
void Reference<Scalar>::add_springs(const Forces& at, Terms<Scalar>& sum) const {
  for (const model::Spring& spring : mechanism_.springs) {
    const auto force = pull(spring, at, &sum);
    detail::push<Scalar>(at.frames[spring.from.value], force, 1, sum);
    detail::push<Scalar>(at.frames[spring.to.value], force, -1, sum);
  }
}

template <class Scalar>
void Reference<Scalar>::add_loads(const Forces& at, Terms<Scalar>& sum) const {
  for (const model::Load& load : mechanism_.loads) {
    const FrameMotion& frame = at.frames[load.frame.value];
    std::array<Bounded<Scalar>, 3> force, moment;
    for (std::size_t k = 0; k < 3; ++k) {
      force[k] = general(load.force[k], at);
      moment[k] = general(load.moment[k], at);
    }
    if (load.axes == model::LoadAxes::kFrame) {
      force = detail::turned(frame.R, force);
      moment = detail::turned(frame.R, moment);
    }
    detail::push<Scalar>(frame, force, 1, sum);
    detail::turn<Scalar>(frame, moment, sum);
  }
}

}  // namespace jourdain::reference
