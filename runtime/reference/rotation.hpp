// Numeric rotation matrices of the reference, written apart from the compiler's own so that the two share no
// code.
#pragma once

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <span>

#include "model/mechanism.hpp"

namespace jourdain::reference {

template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

/// The rotation by `angle` (rad) about the unit vector `axis` (Rodrigues' formula).
template <class Scalar>
Matrix3<Scalar> rotation_about(const Vector3<Scalar>& axis, Scalar angle) {
  using std::cos;
  using std::sin;
  const Scalar c = cos(angle), s = sin(angle);
  Matrix3<Scalar> cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return c * Matrix3<Scalar>::Identity() + s * cross + (1 - c) * axis * axis.transpose();
}

/// The rotation with entries within model::kSnapTolerance of 0 or ±1 replaced by those values; the others
/// stay.
template <class Scalar>
Matrix3<Scalar> snapped(const Matrix3<Scalar>& rotation) {
  using std::abs;
  return rotation.unaryExpr([](Scalar entry) {
    for (const Scalar exact : {Scalar(-1), Scalar(0), Scalar(1)})
      if (abs(entry - exact) <= Scalar(model::kSnapTolerance)) return exact;
    return entry;
  });
}

/// The vector's components (whatever their unit) at the given parameter values.
template <class Scalar>
Vector3<Scalar> vector_value(const model::Vector3& vector, std::span<const Scalar> parameters) {
  return {vector[0].evaluate(parameters), vector[1].evaluate(parameters), vector[2].evaluate(parameters)};
}

/// R = Rz(yaw) Ry(pitch) Rx(roll) at the given parameter values. With `snap`, a rotation that depends on no
/// parameter is `snapped`.
template <class Scalar>
Matrix3<Scalar> rotation_value(const model::Rotation& rotation, std::span<const Scalar> parameters,
                               bool snap) {
  const Vector3<Scalar> rpy = vector_value(rotation.rpy, parameters);
  const Matrix3<Scalar> R = rotation_about<Scalar>(Vector3<Scalar>::UnitZ(), rpy.z()) *
                            rotation_about<Scalar>(Vector3<Scalar>::UnitY(), rpy.y()) *
                            rotation_about<Scalar>(Vector3<Scalar>::UnitX(), rpy.x());
  const bool constant =
      rotation.rpy[0].is_constant() && rotation.rpy[1].is_constant() && rotation.rpy[2].is_constant();
  return snap && constant ? snapped(R) : R;
}

}  // namespace jourdain::reference
