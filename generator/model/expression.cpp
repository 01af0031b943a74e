#include "model/expression.hpp"

#include <algorithm>

#include "model/expression_nodes.hpp"

namespace jourdain::model {

using Op = Expression::Op;

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
  NodeList list;
  std::vector<std::size_t> place;
  for (Node node : nodes_) {
    const int operands = operand_count(node);
    if (operands == 0) {
      place.push_back(node.op == Op::kLiteral ? list.add(node) : list.append(replacement(node)));
      continue;
    }
    node.left = place[node.left];
    node.right = operands == 2 ? place[node.right] : node.left;
    place.push_back(list.add(node));
  }
  return Expression(list.finish(place.back()));
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
  return with_operand({.op = op}, operand);
}

Expression Expression::binary(Op op, const Expression& left, const Expression& right) {
  JD_CHECK(op == Op::kAdd || op == Op::kSubtract || op == Op::kMultiply || op == Op::kDivide, "operation {}",
           static_cast<int>(op));
  return with_operands({.op = op}, left, right);
}

Expression Expression::power(const Expression& base, int exponent) {
  return with_operand({.op = Op::kPower, .exponent = exponent}, base);
}

Expression Expression::function(support::Function function, const Expression& operand) {
  JD_CHECK(support::facts_of(function).operands == 1, "{}", support::facts_of(function).name);
  return with_operand({.op = Op::kFunction, .function = function}, operand);
}

Expression Expression::function(support::Function function, const Expression& left, const Expression& right) {
  JD_CHECK(support::facts_of(function).operands == 2, "{}", support::facts_of(function).name);
  return with_operands({.op = Op::kFunction, .function = function}, left, right);
}

Expression Expression::with_operand(Node node, const Expression& operand) {
  NodeList list;
  node.left = node.right = list.append(operand);
  return Expression(list.finish(list.add(node)));
}

Expression Expression::with_operands(Node node, const Expression& left, const Expression& right) {
  NodeList list;
  node.left = list.append(left);
  node.right = list.append(right);
  return Expression(list.finish(list.add(node)));
}

Expression Expression::composed(std::span<const Expression> operands, const std::vector<Node>& nodes) {
  NodeList list;
  std::vector<std::size_t> place;
  for (const Expression& operand : operands) place.push_back(list.append(operand));
  for (Node node : nodes) {
    if (operand_count(node) > 0) {
      node.left = place.at(node.left);
      node.right = place.at(node.right);
    }
    place.push_back(list.add(node));
  }
  return Expression(list.finish(place.back()));
}

bool Expression::has_undefined_part(std::span<const double> parameters) const {
  std::vector<Node> known = nodes_;
  const std::vector<bool> moves = moved_by_variables(nodes_);
  for (std::size_t i = 0; i < known.size(); ++i) {
    Node& node = known[i];
    if (moves[i]) continue;
    if (node.op == Op::kParameter) node.value = parameters[node.parameter.value];
    if (operand_count(node) > 0) node.value = folded(known, node);
    if (!std::isfinite(node.value)) return true;
  }
  return false;
}

std::size_t Expression::written_out_size() const {
  std::vector<std::size_t> sizes;
  for (const Node& node : nodes_) {
    const int operands = operand_count(node);
    std::size_t size = 1;
    if (operands >= 1) size += sizes[node.left];
    if (operands == 2) size += sizes[node.right];
    sizes.push_back(std::min(size, kMaximumWrittenOutSize + 1));
  }
  return sizes.back();
}

bool Expression::has_kinks() const {
  const std::vector<bool> moves = moved_by_variables(nodes_);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (moves[i] && nodes_[i].op == Op::kFunction && support::facts_of(nodes_[i].function).has_kinks)
      return true;
  return false;
}

bool Expression::calls(support::Function function) const {
  return std::any_of(nodes_.begin(), nodes_.end(), [function](const Node& node) {
    return node.op == Op::kFunction && node.function == function;
  });
}

Expression Expression::tangent(const Expression& operand) {
  const std::vector<Node> nodes = {{.op = Op::kSin, .left = 0, .right = 0},
                                   {.op = Op::kCos, .left = 0, .right = 0},
                                   {.op = Op::kDivide, .left = 1, .right = 2}};
  return composed({&operand, 1}, nodes);
}

}  // namespace jourdain::model
