// Numeric rotation matrices of the reference, written apart from the compiler's own so that the two share no
// code.
#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "model/mechanism.hpp"
#include "reference/plain_products.hpp"

namespace jourdain::reference {

template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

/// Cosine and sine of an angle.
template <class Scalar>
struct Turn {
  Scalar c, s;
};

template <class Scalar>
Turn<Scalar> turn_by(const Scalar& angle) {
  using std::cos, std::sin;
  return {cos(angle), sin(angle)};
}

/// By the multiple of π/6 or π/4 that `angle` (rad) is but for model::kAngleRounding, if it is.
template <class Scalar>
Turn<Scalar> snapped_turn(const Scalar& angle) {
  using std::abs, std::atan2, std::sqrt;
  const Scalar quarter = atan2(Scalar(1), Scalar(0));
  const double count = std::round(static_cast<double>(angle * Scalar(6) / quarter));
  const double rounding = model::kAngleRounding * std::max(1.0, std::fabs(count) / 6);
  if (!(abs(angle - Scalar(count) * quarter / Scalar(6)) <= Scalar(rounding))) return turn_by(angle);
  const int sixths = static_cast<int>(std::fmod(std::fmod(count, 24) + 24, 24));
  Turn<Scalar> turn{Scalar(1), Scalar(0)};
  if (sixths % 6 == 2) turn = {sqrt(Scalar(3)) / Scalar(2), Scalar(1) / Scalar(2)};
  if (sixths % 6 == 3) turn = {sqrt(Scalar(2)) / Scalar(2), sqrt(Scalar(2)) / Scalar(2)};
  if (sixths % 6 == 4) turn = {Scalar(1) / Scalar(2), sqrt(Scalar(3)) / Scalar(2)};
  if (sixths % 6 == 1 || sixths % 6 == 5) return turn_by(angle);
  for (int quarters = sixths / 6; quarters > 0; --quarters) turn = {-turn.s, turn.c};
  return turn;
}

/// The rotation about the unit vector `axis` (Rodrigues' formula).
template <class Scalar>
Matrix3<Scalar> rotation_about(const Vector3<Scalar>& axis, const Turn<Scalar>& turn) {
  const Scalar c = turn.c, s = turn.s;
  Matrix3<Scalar> cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return c * Matrix3<Scalar>::Identity() + s * cross + (Scalar(1) - c) * axis * axis.transpose();
}

template <class Scalar>
Matrix3<Scalar> rotation_about(const Vector3<Scalar>& axis, const Scalar& angle) {
  return rotation_about<Scalar>(axis, turn_by(angle));
}

/// The vector's components (whatever their unit) at the given parameter values.
template <class Scalar>
Vector3<Scalar> vector_value(const model::Vector3& vector, std::span<const Scalar> parameters) {
  return {vector[0].evaluate(parameters), vector[1].evaluate(parameters), vector[2].evaluate(parameters)};
}

/// R = Rz(yaw) Ry(pitch) Rx(roll) at the given parameter values. With `snap`, constant angles that are a
/// multiple of π/6 or π/4 but for model::kAngleRounding are that multiple.
template <class Scalar>
Matrix3<Scalar> rotation_value(const model::Rotation& rotation, std::span<const Scalar> parameters,
                               bool snap) {
  const auto about = [&](std::size_t i) {
    const Scalar angle = rotation.rpy[i].evaluate(parameters);
    return rotation_about<Scalar>(
        Vector3<Scalar>::Unit(Eigen::Index(i)),
        snap && rotation.rpy[i].is_constant() ? snapped_turn(angle) : turn_by(angle));
  };
  return about(2) * about(1) * about(0);
}

}  // namespace jourdain::reference
