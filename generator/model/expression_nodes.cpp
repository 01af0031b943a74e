#include "model/expression_nodes.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace jourdain::model {

using Op = Expression::Op;
using Node = Expression::Node;

int operand_count(const Node& node) {
  const Op op = node.op;
  if (op == Op::kLiteral || op == Op::kParameter || op == Op::kVariable) return 0;
  if (op == Op::kFunction) return support::facts_of(node.function).operands;
  return op == Op::kAdd || op == Op::kSubtract || op == Op::kMultiply || op == Op::kDivide ? 2 : 1;
}

std::vector<bool> moved_by_variables(const std::vector<Expression::Node>& nodes) {
  std::vector<bool> moved;
  for (const Expression::Node& node : nodes) {
    const int operands = operand_count(node);
    moved.push_back(node.op == Expression::Op::kVariable || (operands >= 1 && moved[node.left]) ||
                    (operands == 2 && moved[node.right]));
  }
  return moved;
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

std::size_t NodeList::append(const Expression& expression) {
  std::vector<std::size_t> place;
  place.reserve(expression.nodes().size());
  for (Node node : expression.nodes()) {
    if (operand_count(node) > 0) {
      node.left = place[node.left];
      node.right = place[node.right];
    }
    place.push_back(push(node));
  }
  return place.back();
}

std::size_t NodeList::add(const Node& node) {
  const int operands = operand_count(node);
  const bool is_opaque = node.op == Op::kFunction && support::is_opaque(node.function);
  if (operands > 0 && !is_opaque && is_literal(node.left) && (operands == 1 || is_literal(node.right)))
    return push({.op = Op::kLiteral, .value = folded(nodes_, node)});
  switch (node.op) {
    case Op::kNegate:
      return nodes_[node.left].op == Op::kNegate ? nodes_[node.left].left : push(node);
    case Op::kAdd:
      if (is(node.left, 0)) return node.right;
      return is(node.right, 0) ? node.left : push(node);
    case Op::kSubtract:
      if (is(node.left, 0)) return add({.op = Op::kNegate, .left = node.right, .right = node.right});
      return is(node.right, 0) ? node.left : push(node);
    case Op::kMultiply:
      if (is(node.left, 0) || is(node.right, 0)) return push({.op = Op::kLiteral});
      if (is(node.left, 1)) return node.right;
      return is(node.right, 1) ? node.left : push(node);
    case Op::kDivide:
      if (is(node.left, 0)) return push({.op = Op::kLiteral});
      return is(node.right, 1) ? node.left : push(node);
    case Op::kPower:
      if (node.exponent == 0) return push({.op = Op::kLiteral, .value = 1});
      return node.exponent == 1 ? node.left : push(node);
    case Op::kFunction:
      return function(node);
    default:
      return push(node);
  }
}

std::vector<Expression::Node> NodeList::finish(std::size_t root) const {
  constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
  std::vector<Node> result;
  std::vector<std::size_t> place(nodes_.size(), kNowhere), open = {root};
  const auto has_place = [&](std::size_t operand) {
    if (place[operand] == kNowhere) open.push_back(operand);
    return place[operand] != kNowhere;
  };
  while (!open.empty()) {
    const std::size_t i = open.back();
    Node node = nodes_[i];
    const int operands = operand_count(node);
    if ((operands >= 1 && !has_place(node.left)) || (operands == 2 && !has_place(node.right))) continue;
    open.pop_back();
    if (operands > 0) {
      node.left = place[node.left];
      node.right = operands == 2 ? place[node.right] : node.left;
    }
    place[i] = result.size();
    result.push_back(node);
  }
  return result;
}

std::size_t NodeList::push(Node node) {
  const int operands = operand_count(node);
  if (operands == 0) node.left = 0;
  if (operands < 2) node.right = node.left;
  nodes_.push_back(node);
  const auto [known, is_new] = known_.insert(nodes_.size() - 1);
  if (!is_new) nodes_.pop_back();
  return *known;
}

std::size_t NodeList::function(const Node& node) {
  using support::Function;
  const bool where_negative = node.function == Function::kWhereNegative;
  if (!where_negative && node.function != Function::kWhereNotNegative) return push(node);
  if (is_literal(node.left))
    return (nodes_[node.left].value < 0) == where_negative ? node.right : push({.op = Op::kLiteral});
  return is(node.right, 0) ? node.right : push(node);
}

std::size_t NodeList::Hash::operator()(std::size_t i) const {
  const Node& n = list->nodes_[i];
  auto hash = static_cast<std::size_t>(n.op);
  const auto mix = [&hash](std::size_t value) {
    hash ^= value + 0x9e3779b97f4a7c15u + (hash << 6) + (hash >> 2);
  };
  mix(std::bit_cast<std::uint64_t>(n.value));
  mix(n.parameter.value);
  mix(static_cast<std::size_t>(n.variable.kind));
  mix(n.variable.index);
  mix(n.variable.component);
  mix(static_cast<std::size_t>(n.exponent));
  mix(static_cast<std::size_t>(n.function));
  mix(n.left);
  mix(n.right);
  return hash;
}

/// Zeros of different signs are different.
bool NodeList::Same::operator()(std::size_t i, std::size_t j) const {
  const Node &a = list->nodes_[i], &b = list->nodes_[j];
  return a.op == b.op && std::bit_cast<std::uint64_t>(a.value) == std::bit_cast<std::uint64_t>(b.value) &&
         a.parameter == b.parameter && a.variable == b.variable && a.exponent == b.exponent &&
         a.function == b.function && a.left == b.left && a.right == b.right;
}

}  // namespace jourdain::model
