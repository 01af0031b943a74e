// Motion of a frame while it is carried along the joints of the reference in minimal coordinates.
#pragma once

#include "reference/minimal.hpp"

namespace jourdain::reference {

/// Absolute values of the products of a cross product, added up.
template <class Scalar>
Vector3<Scalar> cross_scale(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  const Vector3<Scalar> l = a.cwiseAbs(), r = b.cwiseAbs();
  return {l.y() * r.z() + l.z() * r.y(), l.z() * r.x() + l.x() * r.z(), l.x() * r.y() + l.y() * r.x()};
}

/// Motion of a frame's origin and of the frame, all in inertial components. Columns belong to all scalar
/// velocities, the prescribed ones too; a_bar and zeta_bar are the accelerations when none of those velocities changes.
template <class Scalar>
struct Reference<Scalar>::FrameMotion {
  Matrix3<Scalar> R;
  Vector3<Scalar> p;
  Jacobian<Scalar> J_t, J_r;
  Vector3<Scalar> a_bar, omega, zeta_bar;
  Vector3<Scalar> p_scale;
  Jacobian<Scalar> J_t_scale, J_r_scale;
  Vector3<Scalar> a_bar_scale, omega_scale, zeta_bar_scale;

  /// Moves the reference point by `r` (m, inertial components), as if fixed in the frame.
  void shift(const Vector3<Scalar>& r) {
    p += r;
    p_scale += Vector3<Scalar>::Constant(r.norm());  // a rounded angle moves r across itself, too
    for (Eigen::Index i = 0; i < J_t.cols(); ++i) {
      J_t.col(i) += Vector3<Scalar>(J_r.col(i)).cross(r);
      J_t_scale.col(i) += cross_scale<Scalar>(J_r_scale.col(i), r);
    }
    a_bar += zeta_bar.cross(r) + omega.cross(omega.cross(r));
    a_bar_scale += cross_scale<Scalar>(zeta_bar_scale, r) +
                   cross_scale<Scalar>(omega_scale, cross_scale<Scalar>(omega_scale, r));
  }

  /// Adds a rotation with the angular velocity `axis` (inertial components) per unit of velocity `column`.
  void turn(const Vector3<Scalar>& axis, Scalar rate, Eigen::Index column) {
    const Vector3<Scalar> w = axis * rate;
    J_r.col(column) += axis;
    J_r_scale.col(column) += axis.cwiseAbs();
    zeta_bar += omega.cross(w);
    zeta_bar_scale += cross_scale<Scalar>(omega_scale, w);
    omega += w;
    omega_scale += w.cwiseAbs();
  }

  /// Adds a translation by `r` with the velocity `direction` per unit of velocity `column`, that changes by `curvature`
  /// per unit of the squared velocity; all fixed in the frame, in inertial components.
  void slide(const Vector3<Scalar>& r, const Vector3<Scalar>& direction, const Vector3<Scalar>& curvature,
             Scalar rate, Eigen::Index column) {
    shift(r);
    J_t.col(column) += direction;
    J_t_scale.col(column) += direction.cwiseAbs();
    const Vector3<Scalar> v = direction * rate;
    a_bar += 2 * omega.cross(v) + curvature * rate * rate;
    a_bar_scale += 2 * cross_scale<Scalar>(omega_scale, v) + (curvature * rate * rate).cwiseAbs();
  }
};

}  // namespace jourdain::reference
