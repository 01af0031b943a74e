// Expressions that are made of others, each of which is there once: nested functions do not grow exponentially.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/expression.hpp"

namespace jourdain::model {

/// Operations on top of arguments. A value is its number: those of the arguments come first.
class Composition {
 public:
  using Op = Expression::Op;

  explicit Composition(std::span<const Expression> arguments) : arguments_(arguments) {}

  std::size_t literal(double value) { return add({.op = Op::kLiteral, .value = value}); }
  std::size_t operation(Op op, std::size_t a, std::size_t b) {
    return add({.op = op, .left = a, .right = b});
  }
  std::size_t operation(Op op, std::size_t a) { return operation(op, a, a); }
  std::size_t sum(std::size_t a, std::size_t b) { return operation(Op::kAdd, a, b); }
  std::size_t difference(std::size_t a, std::size_t b) { return operation(Op::kSubtract, a, b); }
  std::size_t product(std::size_t a, std::size_t b) { return operation(Op::kMultiply, a, b); }
  std::size_t quotient(std::size_t a, std::size_t b) { return operation(Op::kDivide, a, b); }
  std::size_t function(support::Function function, std::size_t a, std::size_t b) {
    return add({.op = Op::kFunction, .function = function, .left = a, .right = b});
  }
  std::size_t function(support::Function of, std::size_t a) { return function(of, a, a); }
  std::size_t square(std::size_t a) { return product(a, a); }
  std::size_t hypotenuse(std::size_t a, std::size_t b) {
    return operation(Op::kSqrt, sum(square(a), square(b)));
  }

  /// The last operation's value.
  Expression finish() const { return Expression::composed(arguments_, nodes_); }

 private:
  std::size_t add(const Expression::Node& node) {
    nodes_.push_back(node);
    return arguments_.size() + nodes_.size() - 1;
  }

  std::span<const Expression> arguments_;
  std::vector<Expression::Node> nodes_;
};

}  // namespace jourdain::model
