#include "model/expression.hpp"

#include <algorithm>

namespace jourdain::model {

namespace {

using Op = Expression::Op;
using Node = Expression::Node;

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

/// Nodes while an expression is built, each simplified as it comes: constants are folded, exact identities applied.
class NodeList {
 public:
  /// The position of the expression's value.
  std::size_t append(const Expression& expression) {
    const std::size_t shift = nodes_.size();
    for (Node node : expression.nodes()) {
      node.left += shift;
      node.right += shift;
      nodes_.push_back(node);
    }
    return nodes_.size() - 1;
  }

  /// A leaf, or an operation on earlier nodes.
  std::size_t add(const Node& node) {
    const int operands = operand_count(node);
    if (operands > 0 && is_literal(node.left) && (operands == 1 || is_literal(node.right)))
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

  /// What the value at `root` needs, in order.
  std::vector<Node> finish(std::size_t root) const {
    std::vector<bool> is_needed(nodes_.size());
    is_needed[root] = true;
    for (std::size_t i = root + 1; i-- > 0;) {
      if (!is_needed[i]) continue;
      const int operands = operand_count(nodes_[i]);
      if (operands >= 1) is_needed[nodes_[i].left] = true;
      if (operands == 2) is_needed[nodes_[i].right] = true;
    }
    std::vector<Node> result;
    std::vector<std::size_t> place(nodes_.size());
    for (std::size_t i = 0; i <= root; ++i) {
      if (!is_needed[i]) continue;
      Node node = nodes_[i];
      if (operand_count(node) > 0) {
        node.left = place[node.left];
        node.right = operand_count(node) == 2 ? place[node.right] : node.left;
      }
      place[i] = result.size();
      result.push_back(node);
    }
    return result;
  }

 private:
  bool is_literal(std::size_t i) const { return nodes_[i].op == Op::kLiteral; }
  bool is(std::size_t i, double value) const { return is_literal(i) && nodes_[i].value == value; }

  std::size_t push(const Node& node) {
    nodes_.push_back(node);
    return nodes_.size() - 1;
  }

  /// What a choice does not take need not have a value.
  std::size_t function(const Node& node) {
    using support::Function;
    const bool where_negative = node.function == Function::kWhereNegative;
    if (!where_negative && node.function != Function::kWhereNotNegative) return push(node);
    if (is_literal(node.left))
      return (nodes_[node.left].value < 0) == where_negative ? node.right : push({.op = Op::kLiteral});
    return is(node.right, 0) ? node.right : push(node);
  }

  std::vector<Node> nodes_;
};

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

std::size_t Expression::written_out_size() const {
  std::vector<std::size_t> sizes;
  for (const Node& node : nodes_) {
    const int operands = operand_count(node);
    std::size_t size = 1;
    if (operands >= 1) size += sizes[node.left];
    if (operands == 2 && node.right != node.left) size += sizes[node.right];
    sizes.push_back(std::min(size, kMaximumWrittenOutSize + 1));
  }
  return sizes.back();
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
  const std::vector<Node> nodes = {{.op = Op::kSin, .left = 0, .right = 0},
                                   {.op = Op::kCos, .left = 0, .right = 0},
                                   {.op = Op::kDivide, .left = 1, .right = 2}};
  return composed({&operand, 1}, nodes);
}

}  // namespace jourdain::model
