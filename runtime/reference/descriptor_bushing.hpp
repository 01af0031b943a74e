// Bushings of the descriptor form. For descriptor_forces.cpp only.
#pragma once

#include <Eigen/Geometry>

#include "reference/descriptor_elements.hpp"

namespace jourdain::reference::descriptor {

/// With the unit quaternion (w, v) of the rotation from `from` to `to`, θ = 2 v, and the moment of ½ Σ k_i θ_i² on `to`
/// is −2 (w K v + v × K v), in the axes of `from`.
template <class Scalar>
Effect<Scalar> effect(const model::Bushing& bushing, const model::Mechanism&, const Scene<Scalar>& scene) {
  const FrameMotion<Scalar>& from = scene.frames[bushing.from.value];
  const FrameMotion<Scalar>& to = scene.frames[bushing.to.value];
  const Vector3<Scalar> between = to.p_WF - from.p_WF;
  const Vector3<Scalar> d = from.R_WF.transpose() * between;
  const Vector3<Scalar> rate = from.R_WF.transpose() * (to.v_F - from.v_F) - from.omega.cross(d);
  const Matrix3<Scalar> R = from.R_WF.transpose() * to.R_WF;
  const Vector3<Scalar> spin = R * to.omega - from.omega;
  const Eigen::Quaternion<Scalar> turn(R);
  const Vector3<Scalar> Kv = value(bushing.torsional_stiffness, scene).cwiseProduct(turn.vec());
  const Vector3<Scalar> back = Scalar(-2) * (turn.w() * Kv + turn.vec().cross(Kv));
  const Vector3<Scalar> damped = value(bushing.torsional_damping, scene).cwiseProduct(spin);
  const Vector3<Scalar> pull =
      value(bushing.stiffness, scene).cwiseProduct(d) + value(bushing.damping, scene).cwiseProduct(rate);
  const Vector3<Scalar> force = -(from.R_WF * pull), moment = from.R_WF * (back - damped);
  return {.at_frames = {{bushing.to, force, moment}, {bushing.from, -force, -moment - between.cross(force)}}};
}

}  // namespace jourdain::reference::descriptor
