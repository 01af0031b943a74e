// Implementation of Reference: functions of the kinematics and of momentum, from the motion of frames and bodies, each
// with its own Jacobian. For minimal.cpp only.
#pragma once

#include "model/kinematic_kinds.hpp"
#include "reference/frame_motion.hpp"

namespace jourdain::reference {

namespace detail {

/// What moves: J (6 × nz), velocity at z = 0, and acceleration less J ż; linear before angular.
template <class Scalar>
struct SixMotion {
  MatrixX<Scalar> J;
  VectorX<Scalar> drift, velocity, bias;
};

template <class Scalar>
VectorX<Scalar> stacked(const Vector3<Scalar>& linear, const Vector3<Scalar>& angular) {
  VectorX<Scalar> six(6);
  six << linear, angular;
  return six;
}

template <class Scalar>
MatrixX<Scalar> stacked(const Jacobian<Scalar>& linear, const Jacobian<Scalar>& angular) {
  MatrixX<Scalar> six(6, linear.cols());
  six << linear, angular;
  return six;
}

/// [v] x = v × x
template <class Scalar>
Matrix3<Scalar> crossing(const Vector3<Scalar>& v) {
  Matrix3<Scalar> matrix;
  matrix << Scalar(0), -v[2], v[1], v[2], Scalar(0), -v[0], -v[1], v[0], Scalar(0);
  return matrix;
}

/// In world axes at the frame's origin, then as `axes` say.
template <class Scalar>
SixMotion<Scalar> six_motion(const BodyMotion<Scalar>& frame, model::Axes axes) {
  const Matrix3<Scalar>& R = frame.R_WB;
  const Vector3<Scalar> omega = R * frame.omega, p = frame.p_WC;
  SixMotion<Scalar> six{stacked<Scalar>(frame.J_t, Jacobian<Scalar>(R * frame.J_r)),
                        stacked<Scalar>(frame.v_bar, R * frame.omega_bar), stacked<Scalar>(frame.v, omega),
                        stacked<Scalar>(frame.a_bar, R * frame.zeta_bar)};
  MatrixX<Scalar> change = MatrixX<Scalar>::Identity(6, 6);
  if (axes == model::Axes::kFrame) {
    change.topLeftCorner(3, 3) = R.transpose();
    change.bottomRightCorner(3, 3) = R.transpose();
  }
  if (axes == model::Axes::kWorld) change.topRightCorner(3, 3) = crossing<Scalar>(p);
  six = {change * six.J, change * six.drift, change * six.velocity, change * six.bias};
  if (axes == model::Axes::kWorld) six.bias.head(3) += frame.v.cross(omega);  // the change's own rate
  return six;
}

/// Momentum of bodies about their centre of mass, as what moves.
template <class Scalar>
struct CentroidalMotion {
  SixMotion<Scalar> momentum;
  Scalar mass = 0;
  Vector3<Scalar> center = Vector3<Scalar>::Zero();
};

}  // namespace detail

template <class Scalar>
detail::CentroidalMotion<Scalar> Reference<Scalar>::centroidal_motion(const State<Scalar>& state) const {
  const std::vector<BodyMotion<Scalar>> bodies = motion(state);
  const auto nz = Eigen::Index(layout_.velocity_count());
  detail::CentroidalMotion<Scalar> all;
  Vector3<Scalar> first = Vector3<Scalar>::Zero();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    all.mass += bodies_[b].mass;
    first += bodies_[b].mass * bodies[b].p_WC;
  }
  all.center = first / all.mass;
  all.momentum = {MatrixX<Scalar>::Zero(6, nz), VectorX<Scalar>::Zero(6), VectorX<Scalar>::Zero(6),
                  VectorX<Scalar>::Zero(6)};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyMotion<Scalar>& body = bodies[b];
    const Matrix3<Scalar> arm = detail::crossing<Scalar>(body.p_WC - all.center);
    const Scalar m = bodies_[b].mass;
    const Matrix3<Scalar>&R = body.R_WB, &I = bodies_[b].I;
    const Vector3<Scalar> gyroscopic = body.omega.cross(I * body.omega);
    const auto add = [&](auto&& sum, const auto& linear, const auto& spin) {
      sum.topRows(3) += m * linear;
      sum.bottomRows(3) += m * (arm * linear) + R * spin;
    };
    add(all.momentum.J, body.J_t, I * body.J_r);
    add(all.momentum.drift, body.v_bar, I * body.omega_bar);
    add(all.momentum.velocity, body.v, I * body.omega);
    add(all.momentum.bias, body.a_bar, Vector3<Scalar>(I * body.zeta_bar + gyroscopic));
  }
  return all;
}

template <class Scalar>
std::vector<KinematicArrays<Scalar>> Reference<Scalar>::kinematics(const State<Scalar>& state,
                                                                   const VectorX<Scalar>& zdot,
                                                                   const VectorX<Scalar>& bias_zdot) const {
  using model::KinematicQuantity;
  std::vector<KinematicArrays<Scalar>> list;
  if (mechanism_.kinematics.empty()) return list;
  const std::vector<BodyMotion<Scalar>> frames = frame_motion(state);
  const auto nz = Eigen::Index(layout_.velocity_count());
  for (const model::KinematicFunction& function : mechanism_.kinematics) {
    KinematicArrays<Scalar>& arrays = list.emplace_back();
    const auto add = [&](const char* name, const auto& values) {
      std::vector<Scalar>& entries = arrays.emplace_back(name, std::vector<Scalar>()).second;
      for (Eigen::Index i = 0; i < values.rows(); ++i)
        for (Eigen::Index j = 0; j < values.cols(); ++j) entries.push_back(values(i, j));
    };
    BodyMotion<Scalar> frame;
    detail::SixMotion<Scalar> six;
    detail::CentroidalMotion<Scalar> all;
    if (function.frame) {
      frame = frames[function.frame->value];
      six = detail::six_motion(frame, function.axes);
    } else {
      all = centroidal_motion(state);
    }
    const detail::SixMotion<Scalar>& h = all.momentum;
    for (const KinematicQuantity quantity : function.quantities) switch (quantity) {
        case KinematicQuantity::kPose:
          add("position", frame.p_WC);
          add("rotation", frame.R_WB);
          break;
        case KinematicQuantity::kVelocity:
          add("velocity", six.velocity);
          break;
        case KinematicQuantity::kAcceleration:
          add("acceleration", VectorX<Scalar>(six.J * zdot + six.bias));
          break;
        case KinematicQuantity::kImu: {
          const Vector3<Scalar> a = frame.J_t * zdot + frame.a_bar - gravity_;
          add("specific_force", Vector3<Scalar>(frame.R_WB.transpose() * a));
          add("angular_velocity", frame.omega);
          break;
        }
        case KinematicQuantity::kJacobian:
          if (nz > 0) add("J", six.J);
          add("drift", six.drift);
          break;
        case KinematicQuantity::kJacobianBias:
          add("bias", VectorX<Scalar>(six.J * bias_zdot + six.bias));
          break;
        case KinematicQuantity::kCenterOfMass:
          add("center_of_mass", all.center);
          break;
        case KinematicQuantity::kCenterOfMassJacobian:
          if (nz > 0) add("J_com", MatrixX<Scalar>(h.J.topRows(3) / all.mass));
          add("drift_com", VectorX<Scalar>(h.drift.head(3) / all.mass));
          break;
        case KinematicQuantity::kCenterOfMassBias:
          add("bias_com", VectorX<Scalar>((h.J * bias_zdot + h.bias).head(3) / all.mass));
          break;
        case KinematicQuantity::kMomentum:
          add("momentum", h.velocity);
          break;
        case KinematicQuantity::kCentroidalMomentumMatrix:
          if (nz > 0) add("A", h.J);
          add("drift_momentum", h.drift);
          break;
        case KinematicQuantity::kCentroidalMomentumBias:
          add("bias_momentum", VectorX<Scalar>(h.J * bias_zdot + h.bias));
          break;
        case KinematicQuantity::kGravityCompensation:
          add("tau_gravity", VectorX<Scalar>(-h.J.topRows(3).transpose() * gravity_));
          break;
        case KinematicQuantity::kInverseOperationalInertia:
          if (nz > 0) add("J_operational", six.J);
          break;
      }
  }
  return list;
}

}  // namespace jourdain::reference
