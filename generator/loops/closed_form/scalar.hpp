// Formulas on values of a program under construction, written as they are on paper.
#pragma once

#include <functional>
#include <initializer_list>
#include <numeric>

#include "ir/builder.hpp"

namespace jourdain::loops {

/// A value of the program that `builder` builds. Operands of one formula have the same builder.
struct Scalar {
  ir::Builder* builder = nullptr;
  ir::Signed value;
};

inline Scalar operator-(Scalar a) { return {a.builder, -a.value}; }
inline Scalar operator+(Scalar a, Scalar b) { return {a.builder, a.builder->add(a.value, b.value)}; }
inline Scalar operator-(Scalar a, Scalar b) { return {a.builder, a.builder->subtract(a.value, b.value)}; }
inline Scalar operator*(Scalar a, Scalar b) { return {a.builder, a.builder->multiply(a.value, b.value)}; }
inline Scalar operator/(Scalar a, Scalar b) { return {a.builder, a.builder->divide(a.value, b.value)}; }
inline Scalar operator*(double a, Scalar b) { return Scalar{b.builder, b.builder->literal(a)} * b; }
inline Scalar operator-(Scalar a, double b) { return a - Scalar{a.builder, a.builder->literal(b)}; }
inline Scalar operator+(Scalar a, double b) { return a - (-b); }
inline Scalar square_root(Scalar a) { return {a.builder, a.builder->unary(ir::Op::kSqrt, a.value)}; }
inline Scalar sine(Scalar a) { return {a.builder, a.builder->unary(ir::Op::kSin, a.value)}; }
inline Scalar cosine(Scalar a) { return {a.builder, a.builder->unary(ir::Op::kCos, a.value)}; }

/// A function of one operand or two.
inline Scalar applied(support::Function function, Scalar a, Scalar b) {
  return {a.builder, a.builder->function(function, a.value, b.value)};
}

/// The angle of (x, y), in (−π, π].
inline Scalar angle_of(Scalar x, Scalar y) { return {x.builder, x.builder->atan2(y.value, x.value)}; }

/// Operands of an operator and arguments of a call are built in an order of the compiler's choice, terms in braces one
/// after the other: where two of them are formulas themselves, they stand in braces.
template <class Term>
Term sum(std::initializer_list<Term> terms) {
  return std::accumulate(terms.begin() + 1, terms.end(), *terms.begin());
}

/// The first less the others.
template <class Term>
Term difference(std::initializer_list<Term> terms) {
  return std::accumulate(terms.begin() + 1, terms.end(), *terms.begin(), std::minus<Term>());
}

inline bool is_zero(Scalar a) { return a.builder->is_literal(a.value, 0); }

inline bool is_literal(Scalar a) { return a.builder->program()[a.value.value].op == ir::Op::kLiteral; }

/// A vector of the plane, or the complex number x + i y.
struct Vector2 {
  Scalar x, y;
};

inline Vector2 operator-(Vector2 a) { return {-a.x, -a.y}; }
inline Vector2 operator+(Vector2 a, Vector2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vector2 operator-(Vector2 a, Vector2 b) { return a + -b; }
inline Vector2 operator*(Scalar a, Vector2 b) { return {a * b.x, a * b.y}; }
inline Vector2 operator/(Vector2 a, Scalar b) { return {a.x / b, a.y / b}; }
inline Scalar dot(Vector2 a, Vector2 b) { return sum({a.x * b.x, a.y * b.y}); }
inline Scalar cross(Vector2 a, Vector2 b) { return difference({a.x * b.y, a.y * b.x}); }

/// Turned by a quarter, counterclockwise.
inline Vector2 quarter(Vector2 a) { return {-a.y, a.x}; }

/// a times the conjugate of b, as complex numbers: a turned back by the angle of b.
inline Vector2 times_conjugate(Vector2 a, Vector2 b) { return {dot(a, b), cross(b, a)}; }

/// Columns of a matrix of two rows.
struct Matrix2 {
  Vector2 first, second;
};

inline Vector2 operator*(const Matrix2& m, Vector2 v) { return sum({v.x * m.first, v.y * m.second}); }
inline Matrix2 operator*(const Matrix2& m, const Matrix2& n) { return {m * n.first, m * n.second}; }
inline Scalar determinant(const Matrix2& m) { return cross(m.first, m.second); }

inline Matrix2 inverse(const Matrix2& m) {
  const Scalar det = determinant(m);
  return {Vector2{m.second.y, -m.first.y} / det, Vector2{-m.second.x, m.first.x} / det};
}

/// A vector of space.
struct Vector3 {
  Scalar x, y, z;

  Scalar operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
};

inline Vector3 operator-(Vector3 a) { return {-a.x, -a.y, -a.z}; }
inline Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector3 operator-(Vector3 a, Vector3 b) { return a + -b; }
inline Vector3 operator*(Scalar a, Vector3 b) { return {a * b.x, a * b.y, a * b.z}; }
inline Vector3 operator/(Vector3 a, Scalar b) { return {a.x / b, a.y / b, a.z / b}; }
inline Scalar dot(Vector3 a, Vector3 b) { return sum({a.x * b.x, a.y * b.y, a.z * b.z}); }
inline Vector3 cross(Vector3 a, Vector3 b) {
  return {difference({a.y * b.z, a.z * b.y}), difference({a.z * b.x, a.x * b.z}),
          difference({a.x * b.y, a.y * b.x})};
}

/// Columns of a matrix of three rows.
struct Matrix3 {
  Vector3 columns[3];
};

inline Vector3 operator*(const Matrix3& m, Vector3 v) {
  return sum({v.x * m.columns[0], v.y * m.columns[1], v.z * m.columns[2]});
}

/// Of the matrix with these rows.
inline Matrix3 inverse_of_rows(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
  const Scalar det = dot(a, bc);
  return {{bc / det, ca / det, ab / det}};
}

/// w x y z
struct Quaternion {
  Scalar w, x, y, z;
};

inline Quaternion conjugate(const Quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  const Vector3 u = {a.x, a.y, a.z}, v = {b.x, b.y, b.z}, imaginary = sum({a.w * v, b.w * u, cross(u, v)});
  return {difference({a.w * b.w, dot(u, v)}), imaginary.x, imaginary.y, imaginary.z};
}

}  // namespace jourdain::loops
