// The little 3 × 3 arithmetic that reading and checking a description need, in double.
#pragma once

#include <array>
#include <optional>

namespace jourdain::model {

using Numbers3 = std::array<double, 3>;
using Matrix3 = std::array<Numbers3, 3>;  ///< rows

inline constexpr Matrix3 kIdentity3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// R = Rz(rpy[2]) Ry(rpy[1]) Rx(rpy[0]); angles in rad, columns are the rotated axes.
Matrix3 rotation_from_rpy(const Numbers3& rpy);

/// Roll, pitch, yaw; the yaw is zero where the pitch is within `tolerance` (rad) of a right angle. Roll is what the
/// rotation without that yaw has left, so that the three together are exact where roll and yaw turn about nearly the
/// same axis.
Numbers3 rpy_of(const Matrix3& R, double tolerance = 0);

/// Of w x y z of any length; nothing where that is zero or not finite.
std::optional<Matrix3> rotation_from_quaternion(const std::array<double, 4>& q);
/// Unit quaternion w x y z of a rotation, w not negative.
std::array<double, 4> quaternion_of(const Matrix3& R);

Matrix3 transposed(const Matrix3& a);
Matrix3 product(const Matrix3& a, const Matrix3& b);
Numbers3 product(const Matrix3& a, const Numbers3& v);
Numbers3 sum(const Numbers3& a, const Numbers3& b);
Matrix3 sum(const Matrix3& a, const Matrix3& b);
Matrix3 scaled(const Matrix3& a, double factor);

/// R a Rᵀ: the tensor `a` given in axes that R turns into the result's.
Matrix3 turned(const Matrix3& R, const Matrix3& a);

/// rᵀr 1 − r rᵀ: inertia about the origin of a unit mass at `r`.
Matrix3 point_inertia(const Numbers3& r);

/// Eigenvalues of the symmetric matrix `a`, ascending, to rounding of its largest entry (cyclic Jacobi
/// rotations).
Numbers3 symmetric_eigenvalues(const Matrix3& a);

}  // namespace jourdain::model
