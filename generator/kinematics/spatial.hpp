// Three-vectors and 3 × 3 matrices of GiNaC expressions; just the products that the derivation needs.
#pragma once

#include <ginac/ginac.h>

#include <cstddef>

namespace jourdain::kinematics {

using Ex = GiNaC::ex;

struct Vector3 {
  Ex entries[3];

  Ex& operator[](std::size_t i) { return entries[i]; }
  const Ex& operator[](std::size_t i) const { return entries[i]; }
};

struct Matrix3 {
  Vector3 rows[3];

  Vector3& operator[](std::size_t row) { return rows[row]; }
  const Vector3& operator[](std::size_t row) const { return rows[row]; }
};

inline Vector3 zero_vector() { return {0, 0, 0}; }
inline Matrix3 zero_matrix() { return {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}; }
inline Matrix3 identity_matrix() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector3 operator*(const Ex& a, const Vector3& b) { return {a * b[0], a * b[1], a * b[2]}; }

inline Vector3 operator*(const Matrix3& A, const Vector3& b) {
  Vector3 product;
  for (std::size_t i = 0; i < 3; ++i) product[i] = A[i][0] * b[0] + A[i][1] * b[1] + A[i][2] * b[2];
  return product;
}

inline Matrix3 operator+(const Matrix3& A, const Matrix3& B) {
  Matrix3 sum;
  for (std::size_t i = 0; i < 3; ++i) sum[i] = A[i] + B[i];
  return sum;
}

inline Matrix3 operator*(const Matrix3& A, const Matrix3& B) {
  Matrix3 product;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      product[i][j] = A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j];
  return product;
}

inline Matrix3 transpose(const Matrix3& A) {
  Matrix3 T;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) T[i][j] = A[j][i];
  return T;
}

inline bool is_zero(const Vector3& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

inline Ex dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a bᵀ + b aᵀ
inline Matrix3 symmetric_outer(const Vector3& a, const Vector3& b) {
  Matrix3 S;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) S[i][j] = a[i] * b[j] + b[i] * a[j];
  return S;
}

}  // namespace jourdain::kinematics
