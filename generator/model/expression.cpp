#include "model/expression.hpp"

#include <algorithm>

namespace jourdain::model {

namespace {

using Op = Expression::Op;
using Node = Expression::Node;

/// Appends the nodes of `expression`; the position of its value.
std::size_t append(std::vector<Node>& nodes, const Expression& expression) {
  const std::size_t shift = nodes.size();
  for (Node node : expression.nodes()) {
    node.left += shift;
    node.right += shift;
    nodes.push_back(node);
  }
  return nodes.size() - 1;
}

double folded(const std::vector<Node>& nodes, const Node& operation) {
  const auto value = [&](std::size_t i) { return nodes[i].value; };
  switch (operation.op) {
    case Op::kLiteral:
    case Op::kParameter:
    case Op::kVariable:
      break;
    case Op::kNegate:
      return -value(operation.left);
    case Op::kAdd:
      return value(operation.left) + value(operation.right);
    case Op::kSubtract:
      return value(operation.left) - value(operation.right);
    case Op::kMultiply:
      return value(operation.left) * value(operation.right);
    case Op::kDivide:
      return value(operation.left) / value(operation.right);
    case Op::kPower: {
      double product = 1;
      for (int i = 0; i < std::abs(operation.exponent); ++i) product *= value(operation.left);
      return operation.exponent < 0 ? 1 / product : product;
    }
    case Op::kSqrt:
      return std::sqrt(value(operation.left));
    case Op::kSin:
      return std::sin(value(operation.left));
    case Op::kCos:
      return std::cos(value(operation.left));
    case Op::kFunction:
      return support::value_of(operation.function, value(operation.left), value(operation.right));
  }
  JD_CHECK(false, "operation {}", static_cast<int>(operation.op));
}

int operand_count(const Node& node) {
  const Op op = node.op;
  if (op == Op::kLiteral || op == Op::kParameter || op == Op::kVariable) return 0;
  if (op == Op::kFunction) return support::facts_of(node.function).operands;
  return op == Op::kAdd || op == Op::kSubtract || op == Op::kMultiply || op == Op::kDivide ? 2 : 1;
}

bool is_number(const Expression& expression, double value) {
  return expression.is_constant() && expression.constant() == value;
}

}  // namespace

Expression Expression::parameter(ParameterIndex index) {
  Expression result;
  result.nodes_ = {Node{.op = Op::kParameter, .parameter = index}};
  return result;
}

Expression Expression::variable(const Variable& variable) {
  Expression result;
  result.nodes_ = {Node{.op = Op::kVariable, .variable = variable}};
  return result;
}

template <class Replacement>
Expression Expression::with_leaves(const Replacement& replacement) const {
  std::vector<Expression> values;
  for (const Node& node : nodes_) {
    switch (operand_count(node)) {
      case 0:
        values.push_back(node.op == Op::kLiteral ? Expression(node.value) : replacement(node));
        break;
      case 1:
        values.push_back(node.op == Op::kPower      ? power(values[node.left], node.exponent)
                         : node.op == Op::kFunction ? function(node.function, values[node.left])
                                                    : unary(node.op, values[node.left]));
        break;
      default:
        values.push_back(node.op == Op::kFunction
                             ? function(node.function, values[node.left], values[node.right])
                             : binary(node.op, values[node.left], values[node.right]));
    }
  }
  return values.back();
}

Expression Expression::substituted(const std::function<Expression(const Variable&)>& replacement) const {
  return with_leaves([&replacement](const Node& leaf) {
    return leaf.op == Op::kVariable ? replacement(leaf.variable) : parameter(leaf.parameter);
  });
}

Expression Expression::with_parameters(const std::function<Expression(ParameterIndex)>& replacement) const {
  return with_leaves([&replacement](const Node& leaf) {
    return leaf.op == Op::kParameter ? replacement(leaf.parameter) : variable(leaf.variable);
  });
}

bool Expression::has_no_variable() const {
  return std::none_of(nodes_.begin(), nodes_.end(), [](const Node& n) { return n.op == Op::kVariable; });
}

double Expression::constant() const {
  JD_CHECK(is_constant(), "{} nodes", nodes_.size());
  return nodes_[0].value;
}

Expression Expression::unary(Op op, const Expression& operand) {
  JD_CHECK(op == Op::kNegate || op == Op::kSqrt || op == Op::kSin || op == Op::kCos, "operation {}",
           static_cast<int>(op));
  Expression result;
  result.nodes_.clear();
  const std::size_t value = append(result.nodes_, operand);
  const Node node{.op = op, .left = value, .right = value};
  if (operand.is_constant()) return Expression(folded(result.nodes_, node));
  if (op == Op::kNegate && result.nodes_.back().op == Op::kNegate && result.nodes_.back().left == value - 1) {
    result.nodes_.pop_back();
    return result;
  }
  result.nodes_.push_back(node);
  return result;
}

Expression Expression::binary(Op op, const Expression& left, const Expression& right) {
  const bool add = op == Op::kAdd;
  const bool subtract = op == Op::kSubtract;
  const bool multiply = op == Op::kMultiply;
  const bool divide = op == Op::kDivide;
  JD_CHECK(add || subtract || multiply || divide, "operation {}", static_cast<int>(op));
  const bool constant = left.is_constant() && right.is_constant();
  if (!constant) {
    if ((add || subtract) && right.is_zero()) return left;
    if (add && left.is_zero()) return right;
    if (subtract && left.is_zero()) return unary(Op::kNegate, right);
    if (multiply && (left.is_zero() || right.is_zero())) return Expression(0.0);
    if (divide && left.is_zero()) return Expression(0.0);
    if ((multiply || divide) && is_number(right, 1)) return left;
    if (multiply && is_number(left, 1)) return right;
  }
  Expression result;
  result.nodes_.clear();
  Node node{.op = op};
  node.left = append(result.nodes_, left);
  node.right = append(result.nodes_, right);
  if (constant) return Expression(folded(result.nodes_, node));
  result.nodes_.push_back(node);
  return result;
}

Expression Expression::power(const Expression& base, int exponent) {
  if (exponent == 0) return Expression(1.0);
  if (exponent == 1) return base;
  Expression result;
  result.nodes_.clear();
  const std::size_t value = append(result.nodes_, base);
  const Node node{.op = Op::kPower, .exponent = exponent, .left = value, .right = value};
  if (base.is_constant()) return Expression(folded(result.nodes_, node));
  result.nodes_.push_back(node);
  return result;
}

Expression Expression::function(support::Function function, const Expression& operand) {
  JD_CHECK(support::facts_of(function).operands == 1, "{}", support::facts_of(function).name);
  Expression result;
  result.nodes_.clear();
  const std::size_t value = append(result.nodes_, operand);
  const Node node{.op = Op::kFunction, .function = function, .left = value, .right = value};
  if (operand.is_constant()) return Expression(folded(result.nodes_, node));
  result.nodes_.push_back(node);
  return result;
}

Expression Expression::function(support::Function function, const Expression& left, const Expression& right) {
  JD_CHECK(support::facts_of(function).operands == 2, "{}", support::facts_of(function).name);
  using support::Function;
  const bool selects = function == Function::kWhereNegative || function == Function::kWhereNotNegative;
  if (selects && left.is_constant())
    return (left.constant() < 0) == (function == Function::kWhereNegative) ? right : Expression(0.0);
  if (selects && right.is_zero()) return right;
  Expression result;
  result.nodes_.clear();
  Node node{.op = Op::kFunction, .function = function};
  node.left = append(result.nodes_, left);
  node.right = append(result.nodes_, right);
  if (left.is_constant() && right.is_constant()) return Expression(folded(result.nodes_, node));
  result.nodes_.push_back(node);
  return result;
}

Expression Expression::composed(std::span<const Expression> operands, const std::vector<Node>& nodes) {
  Expression result;
  result.nodes_.clear();
  std::vector<std::size_t> place;
  for (const Expression& operand : operands) place.push_back(append(result.nodes_, operand));
  for (Node node : nodes) {
    if (operand_count(node) > 0) {
      node.left = place.at(node.left);
      node.right = place.at(node.right);
    }
    place.push_back(result.nodes_.size());
    result.nodes_.push_back(node);
  }
  const bool constant =
      std::all_of(operands.begin(), operands.end(), [](const Expression& e) { return e.is_constant(); });
  return constant ? Expression(result.evaluate<double>({})) : result;
}

bool Expression::has_undefined_part(std::span<const double> parameters) const {
  std::vector<Node> known = nodes_;
  std::vector<bool> moves;
  for (Node& node : known) {
    const int operands = operand_count(node);
    moves.push_back(node.op == Op::kVariable || (operands >= 1 && moves[node.left]) ||
                    (operands == 2 && moves[node.right]));
    if (moves.back()) continue;
    if (node.op == Op::kParameter) node.value = parameters[node.parameter.value];
    if (operands > 0) node.value = folded(known, node);
    if (!std::isfinite(node.value)) return true;
  }
  return false;
}

bool Expression::has_kinks() const {
  return std::any_of(nodes_.begin(), nodes_.end(), [](const Node& node) {
    return node.op == Op::kFunction && support::facts_of(node.function).has_kinks;
  });
}

bool Expression::calls(support::Function function) const {
  return std::any_of(nodes_.begin(), nodes_.end(), [function](const Node& node) {
    return node.op == Op::kFunction && node.function == function;
  });
}

Expression Expression::tangent(const Expression& operand) {
  if (operand.is_constant()) return Expression(std::sin(operand.constant()) / std::cos(operand.constant()));
  Expression result;
  result.nodes_.clear();
  const std::size_t value = append(result.nodes_, operand);
  result.nodes_.push_back(Node{.op = Op::kSin, .left = value, .right = value});
  result.nodes_.push_back(Node{.op = Op::kCos, .left = value, .right = value});
  result.nodes_.push_back(Node{.op = Op::kDivide, .left = value + 1, .right = value + 2});
  return result;
}

}  // namespace jourdain::model
