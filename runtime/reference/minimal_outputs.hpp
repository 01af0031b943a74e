// Implementation of Reference: outputs. For minimal.cpp only.
#pragma once

#include "reference/minimal_elements.hpp"

namespace jourdain::reference {

namespace detail {

template <class Scalar, class Values, class Scales>
void append(OutputValue<Scalar>& output, const Values& values, const Scales& scales) {
  for (Eigen::Index row = 0; row < values.rows(); ++row)
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      output.values.push_back(values(row, column));
      output.scales.push_back(scales(row, column));
    }
}

}  // namespace detail

template <class Scalar>
OutputValue<Scalar> Reference<Scalar>::output(const model::Output& output, const Forces& at,
                                              const Terms<Scalar>& terms,
                                              const Accelerations& accelerations) const {
  using Kind = model::OutputKind;
  OutputValue<Scalar> result;
  const auto nz = Eigen::Index(layout_.velocity_count());
  const VectorX<Scalar> zdot = accelerations.values.head(nz), zdot_s = accelerations.scales.head(nz);
  const auto view = [&] { return seen(at.frames[output.frame.value], at.state); };
  switch (output.kind) {
    case Kind::kPose: {
      const BodyMotion<Scalar> frame = view();
      detail::append(result, frame.p_WC, frame.p_scale);
      detail::append(result, frame.R_WB, Matrix3<Scalar>::Ones());
      break;
    }
    case Kind::kVelocity: {
      const BodyMotion<Scalar> frame = view();
      detail::append(result, frame.v, frame.v_scale);
      detail::append(result, frame.omega, frame.omega_scale);
      break;
    }
    case Kind::kAcceleration: {
      const BodyMotion<Scalar> frame = view();
      const Vector3<Scalar> a_s = frame.J_t_scale * zdot_s + frame.a_bar_scale;
      const Vector3<Scalar> alpha_s = frame.J_r_scale * zdot_s + frame.zeta_bar_scale;
      detail::append(result, frame.J_t * zdot + frame.a_bar, a_s);
      detail::append(result, frame.J_r * zdot + frame.zeta_bar, alpha_s);
      break;
    }
    case Kind::kJacobian: {
      const BodyMotion<Scalar> frame = view();
      detail::append(result, frame.J_t, frame.J_t_scale);
      detail::append(result, frame.J_r, frame.J_r_scale);
      detail::append(result, frame.v_bar, frame.v_scale);
      detail::append(result, frame.omega_bar, frame.omega_scale);
      detail::append(result, frame.a_bar, frame.a_bar_scale);
      detail::append(result, frame.zeta_bar, frame.zeta_bar_scale);
      break;
    }
    case Kind::kReaction:
      return reaction(output.joint.value, at, accelerations);
    case Kind::kDrive: {
      const Eigen::Index row = column_of(output.joint.value, output.coordinate);
      result.values = {terms.M.row(row).dot(accelerations.values) - terms.k_bar[row] + terms.q_bar[row]};
      result.scales = {terms.M_scale.row(row).dot(accelerations.scales) + terms.k_scale[row] +
                       terms.q_scale[row]};
      break;
    }
    case Kind::kKineticEnergy:
      result.values = {terms.kinetic_energy};
      result.scales = {terms.kinetic_scale};
      break;
    case Kind::kPotentialEnergy:
      result.values = {terms.potential_energy};
      result.scales = {terms.potential_scale};
      break;
    case Kind::kExpression: {
      const Bounded<Scalar> value = general(output.value, at);
      result.values = {value.value};
      result.scales = {value.scale};
      break;
    }
  }
  return result;
}

/// Σ over the bodies that the joint carries of inertia wrench less applied wrench, about the child's origin, in child
/// components. Springs and drives of the joint itself are part of what it transmits; the moment that
/// accelerates a rotor is not.
template <class Scalar>
OutputValue<Scalar> Reference<Scalar>::reaction(std::size_t joint, const Forces& at,
                                                const Accelerations& accelerations) const {
  const std::size_t child = mechanism_.joints[joint].child.value;
  std::vector<bool> carried(bodies_.size(), false);
  carried[child] = true;
  for (const model::JointIndex index : order_) {
    const model::Joint& outer = mechanism_.joints[index.value];
    if (outer.parent && carried[outer.parent->value]) carried[outer.child.value] = true;
  }
  const Vector3<Scalar> origin = at.bodies[child].p, origin_s = at.bodies[child].p_scale;
  Vector3<Scalar> force = Vector3<Scalar>::Zero(), moment = force, force_s = force, moment_s = force;
  const auto add = [&](const Vector3<Scalar>& f, const Vector3<Scalar>& f_s, const Vector3<Scalar>& n,
                       const Vector3<Scalar>& n_s, const FrameMotion& point) {
    force += f;
    force_s += f_s;
    moment += n + Vector3<Scalar>(point.p - origin).cross(f);
    moment_s += n_s + cross_scale<Scalar>(point.p_scale + origin_s, f_s);
  };
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!carried[b]) continue;
    FrameMotion c = at.bodies[b];
    c.shift(c.R * bodies_[b].p_BC);
    const Vector3<Scalar> a = c.J_t * accelerations.values + c.a_bar - gravity_;
    const Vector3<Scalar> a_s = c.J_t_scale * accelerations.scales + c.a_bar_scale + gravity_.cwiseAbs();
    const Vector3<Scalar> alpha = c.J_r * accelerations.values + c.zeta_bar;
    const Vector3<Scalar> alpha_s = c.J_r_scale * accelerations.scales + c.zeta_bar_scale;
    const Matrix3<Scalar> I = c.R * bodies_[b].I * c.R.transpose();
    const Matrix3<Scalar> I_s = c.R.cwiseAbs() * bodies_[b].I_scale * c.R.cwiseAbs().transpose();
    const Vector3<Scalar> n = I * alpha + c.omega.cross(I * c.omega);
    const Vector3<Scalar> n_s = I_s * alpha_s + cross_scale<Scalar>(c.omega_scale, I_s * c.omega_scale);
    add(bodies_[b].mass * a, bodies_[b].mass * a_s, n, n_s, c);
  }
  const auto vector = [](const auto& v) { return Vector3<Scalar>(v[0].value, v[1].value, v[2].value); };
  const auto scale = [](const auto& v) { return Vector3<Scalar>(v[0].scale, v[1].scale, v[2].scale); };
  for_each_force_element(mechanism_, [&](const auto& element) {
    const Effect applied = effect(element, at);
    for (const auto& [frame, f, n] : applied.at_frames)
      if (const auto& body = mechanism_.frames[frame.value].body; body && carried[body->value])
        add(-vector(f), scale(f), -vector(n), scale(n), at.frames[frame.value]);
  });
  const Matrix3<Scalar> R = at.bodies[child].R.transpose(), R_s = R.cwiseAbs();
  OutputValue<Scalar> result;
  detail::append(result, R * force, Vector3<Scalar>(R_s * force_s));
  detail::append(result, R * moment, Vector3<Scalar>(R_s * moment_s));
  return result;
}

template <class Scalar>
std::vector<OutputValue<Scalar>> Reference<Scalar>::outputs(const State<Scalar>& state,
                                                            const VectorX<Scalar>& u,
                                                            const VectorX<Scalar>& zdot,
                                                            const VectorX<Scalar>& zdot_scale) const {
  const Forces at = forces(state, u);
  const Terms<Scalar> terms = all_columns(at);
  Accelerations all{VectorX<Scalar>(column_count()), VectorX<Scalar>(column_count())};
  const VectorX<Scalar> prescribed = prescribed_accelerations(at.state);
  all.values << zdot, prescribed;
  all.scales << zdot_scale, prescribed.cwiseAbs();
  std::vector<OutputValue<Scalar>> values;
  for (const model::Output& wanted : mechanism_.outputs) values.push_back(output(wanted, at, terms, all));
  return values;
}

}  // namespace jourdain::reference
