// Sums and products of expressions, with what Expression::binary simplifies.
#pragma once

#include "model/expression.hpp"

namespace jourdain::model {

inline Expression plus(const Expression& a, const Expression& b) {
  return Expression::binary(Expression::Op::kAdd, a, b);
}
inline Expression minus(const Expression& a, const Expression& b) {
  return Expression::binary(Expression::Op::kSubtract, a, b);
}
inline Expression times(const Expression& a, const Expression& b) {
  return Expression::binary(Expression::Op::kMultiply, a, b);
}

inline Vector3 plus(const Vector3& a, const Vector3& b) {
  return {plus(a[0], b[0]), plus(a[1], b[1]), plus(a[2], b[2])};
}
inline Vector3 times(const Expression& factor, const Vector3& v) {
  return {times(factor, v[0]), times(factor, v[1]), times(factor, v[2])};
}
inline Vector3 minus(const Vector3& a, const Vector3& b) {
  return {minus(a[0], b[0]), minus(a[1], b[1]), minus(a[2], b[2])};
}
inline Expression dot(const Vector3& a, const Vector3& b) {
  return plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]));
}
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {minus(times(a[1], b[2]), times(a[2], b[1])), minus(times(a[2], b[0]), times(a[0], b[2])),
          minus(times(a[0], b[1]), times(a[1], b[0]))};
}

}  // namespace jourdain::model
