#include "model/matrix3.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace jourdain::model {

namespace {

/// Turns axes p and q of `a` so that the entry (p, q) becomes zero.
void annihilate(Matrix3& a, std::size_t p, std::size_t q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0);
  Matrix3 R = kIdentity3;
  R[p][p] = R[q][q] = c;
  R[p][q] = -t * c;
  R[q][p] = t * c;
  a = turned(R, a);
  a[p][q] = a[q][p] = 0;
}

}  // namespace

Matrix3 rotation_from_rpy(const Numbers3& rpy) {
  const double cr = std::cos(rpy[0]), sr = std::sin(rpy[0]);
  const double cp = std::cos(rpy[1]), sp = std::sin(rpy[1]);
  const double cy = std::cos(rpy[2]), sy = std::sin(rpy[2]);
  return {{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
           {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
           {-sp, cp * sr, cp * cr}}};
}

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  return result;
}

Numbers3 product(const Matrix3& a, const Numbers3& v) {
  Numbers3 result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = a[i][0] * v[0] + a[i][1] * v[1] + a[i][2] * v[2];
  return result;
}

Numbers3 sum(const Numbers3& a, const Numbers3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Matrix3 sum(const Matrix3& a, const Matrix3& b) {
  return {sum(a[0], b[0]), sum(a[1], b[1]), sum(a[2], b[2])};
}

Matrix3 scaled(const Matrix3& a, double factor) {
  Matrix3 result = a;
  for (Numbers3& row : result)
    for (double& entry : row) entry *= factor;
  return result;
}

Matrix3 turned(const Matrix3& R, const Matrix3& a) { return product(product(R, a), transposed(R)); }

Matrix3 point_inertia(const Numbers3& r) {
  const double square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  Matrix3 result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = (i == j ? square : 0) - r[i] * r[j];
  return result;
}

Numbers3 symmetric_eigenvalues(const Matrix3& a) {
  constexpr int kSweeps = 12;  // convergence is quadratic, five are enough for 3 × 3
  Matrix3 m = a;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    annihilate(m, 0, 1);
    annihilate(m, 0, 2);
    annihilate(m, 1, 2);
  }
  Numbers3 values{m[0][0], m[1][1], m[2][2]};
  std::sort(values.begin(), values.end());
  return values;
}

Matrix3 transposed(const Matrix3& a) {
  return {{{a[0][0], a[1][0], a[2][0]}, {a[0][1], a[1][1], a[2][1]}, {a[0][2], a[1][2], a[2][2]}}};
}

Numbers3 rpy_of(const Matrix3& R, double tolerance) {
  const double level = std::hypot(R[0][0], R[1][0]);
  const double yaw = level <= tolerance ? 0.0 : std::atan2(R[1][0], R[0][0]);
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {std::atan2(s * R[0][2] - c * R[1][2], c * R[1][1] - s * R[0][1]),
          std::atan2(-R[2][0], c * R[0][0] + s * R[1][0]), yaw};
}

std::optional<Matrix3> rotation_from_quaternion(const std::array<double, 4>& q) {
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!(length > 0) || !std::isfinite(length)) return {};
  const double w = q[0] / length, x = q[1] / length, y = q[2] / length, z = q[3] / length;
  return Matrix3{{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                  {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                  {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
}

std::array<double, 4> quaternion_of(const Matrix3& R) {
  // The largest of 4w², 4x², 4y², 4z², so that nothing is divided by what is small.
  const double trace = R[0][0] + R[1][1] + R[2][2];
  const std::array<double, 4> squares{1 + trace, 1 + 2 * R[0][0] - trace, 1 + 2 * R[1][1] - trace,
                                      1 + 2 * R[2][2] - trace};
  std::size_t k = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (squares[i] > squares[k]) k = i;
  std::array<double, 4> q{};
  if (k == 0) {
    q = {squares[0], R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]};
  } else {
    const std::size_t i = k - 1, j = k % 3, l = (k + 1) % 3;
    q[0] = R[l][j] - R[j][l];
    q[k] = squares[k];
    q[j + 1] = R[i][j] + R[j][i];
    q[l + 1] = R[i][l] + R[l][i];
  }
  const double length = std::copysign(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])), q[0]);
  for (double& entry : q) entry /= length;
  return q;
}

}  // namespace jourdain::model
