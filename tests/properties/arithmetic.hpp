// Arithmetic on expressions for mechanisms that tests put together.
#pragma once

#include "model/expression.hpp"

namespace jourdain::tests {

inline model::Expression operator+(const model::Expression& a, const model::Expression& b) {
  return model::Expression::binary(model::Expression::Op::kAdd, a, b);
}
inline model::Expression operator-(const model::Expression& a, const model::Expression& b) {
  return model::Expression::binary(model::Expression::Op::kSubtract, a, b);
}
inline model::Expression operator*(const model::Expression& a, const model::Expression& b) {
  return model::Expression::binary(model::Expression::Op::kMultiply, a, b);
}
inline model::Expression operator/(const model::Expression& a, const model::Expression& b) {
  return model::Expression::binary(model::Expression::Op::kDivide, a, b);
}
inline model::Expression sine(const model::Expression& a) {
  return model::Expression::unary(model::Expression::Op::kSin, a);
}
inline model::Expression cosine(const model::Expression& a) {
  return model::Expression::unary(model::Expression::Op::kCos, a);
}
inline model::Expression variable(model::Variable::Kind kind, std::size_t index = 0,
                                  std::size_t component = 0) {
  return model::Expression::variable({kind, index, component});
}

}  // namespace jourdain::tests
