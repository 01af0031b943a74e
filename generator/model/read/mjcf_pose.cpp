#include "model/read/mjcf_pose.hpp"

#include <cctype>
#include <cmath>

namespace jourdain::model {

namespace {

Numbers3 cross(const Numbers3& a, const Numbers3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Numbers3& a, const Numbers3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::optional<Numbers3> unit(const Numbers3& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  if (!(length > 0) || !std::isfinite(length)) return {};
  return Numbers3{v[0] / length, v[1] / length, v[2] / length};
}

/// About a unit vector.
Matrix3 turned_about(const Numbers3& u, double c, double s) {
  Matrix3 R{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) R[i][j] = u[i] * u[j] * (1 - c) + (i == j ? c : 0);
  R[0][1] -= u[2] * s;
  R[1][0] += u[2] * s;
  R[0][2] += u[1] * s;
  R[2][0] -= u[1] * s;
  R[1][2] -= u[0] * s;
  R[2][1] += u[0] * s;
  return R;
}

}  // namespace

Numbers3 times(const Numbers3& v, double factor) { return {v[0] * factor, v[1] * factor, v[2] * factor}; }

Numbers3 point_at(const Pose& pose, const Numbers3& point) {
  return sum(pose.origin, product(pose.R, point));
}

Pose composed(const Pose& outer, const Pose& inner) {
  return {point_at(outer, inner.origin), product(outer.R, inner.R)};
}

Pose inverse(const Pose& pose) {
  const Matrix3 R = transposed(pose.R);
  return {times(product(R, pose.origin), -1), R};
}

std::optional<Matrix3> rotation_about(const Numbers3& axis, double angle) {
  const std::optional<Numbers3> u = unit(axis);
  if (!u || !std::isfinite(angle)) return {};
  return turned_about(*u, std::cos(angle), std::sin(angle));
}

std::optional<Matrix3> rotation_from_axes(const Numbers3& x, const Numbers3& y) {
  const std::optional<Numbers3> ux = unit(x), direction = unit(y);
  if (!ux || !direction) return {};
  const std::optional<Numbers3> uy = unit(sum(*direction, times(*ux, -dot(*ux, *direction))));
  if (!uy) return {};
  return transposed({*ux, *uy, cross(*ux, *uy)});
}

std::optional<Matrix3> rotation_to(const Numbers3& z) {
  const std::optional<Numbers3> to = unit(z);
  if (!to) return {};
  const std::optional<Numbers3> axis = unit({-(*to)[1], (*to)[0], 0});
  if (!axis) return turned_about({1, 0, 0}, (*to)[2], 0);
  return turned_about(*axis, (*to)[2], std::hypot((*to)[0], (*to)[1]));
}

Matrix3 rotation_from_euler(const Numbers3& angles, const std::string& sequence) {
  Matrix3 R = kIdentity3;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool moving = std::islower(static_cast<unsigned char>(sequence[i])) != 0;
    Numbers3 axis{};
    axis[static_cast<std::size_t>(std::tolower(static_cast<unsigned char>(sequence[i])) - 'x')] = 1;
    const Matrix3 turn = turned_about(axis, std::cos(angles[i]), std::sin(angles[i]));
    R = moving ? product(R, turn) : product(turn, R);
  }
  return R;
}

Placement placement_of(const Pose& pose, SourceRange where) {
  const Numbers3 rpy = rpy_of(pose.R);
  return {{pose.origin[0], pose.origin[1], pose.origin[2]}, {{rpy[0], rpy[1], rpy[2]}, where}};
}

}  // namespace jourdain::model
