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

}  // namespace jourdain::model
