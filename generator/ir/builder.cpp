#include "ir/builder.hpp"

#include <cln/cln.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

namespace jourdain::ir {

namespace {

constexpr std::size_t kSmallestTable = 256;

/// Literals this near to a double, relatively, are it: 0.7 (1/0.7) is 1.
constexpr double kRounding = 1e-61;

/// 0 where they cancel but for their rounding.
cln::cl_R sum_of(const cln::cl_R& a, const cln::cl_R& b) {
  const cln::cl_R sum = a + b;
  const cln::cl_R larger = cln::max(cln::abs(a), cln::abs(b));
  return cln::abs(sum) < cln::rational(cln::cl_DF(kRounding)) * larger ? cln::cl_R(0) : sum;
}

std::size_t hash(const Node& node) {
  auto h = static_cast<std::size_t>(node.op);
  const auto mix = [&h](std::size_t x) { h = (h ^ x) * 0x9E3779B97F4A7C15ull + (h >> 29); };
  if (node.op == Op::kLiteral) {
    mix(std::hash<double>{}(node.literal));
    mix(std::hash<double>{}(node.tail[0]));
  } else if (node.op == Op::kLeaf) {
    mix(static_cast<std::size_t>(node.leaf) + 31 * std::size_t(node.index));
  } else {
    mix(node.a.value);
    mix(node.b.value);
  }
  return h ^ (h >> 32);
}

/// A literal with the other sign; zero has none.
Node negated(Node literal) {
  literal.literal = -literal.literal;
  for (double& part : literal.tail)
    if (part != 0) part = -part;
  return literal;
}

}  // namespace

Builder::Builder(std::size_t count) {
  program_.nodes.reserve(count);
  program_.labels.reserve(count);
  grow(std::bit_ceil(std::max(kSmallestTable, 2 * count + 2)));
}

void Builder::grow(std::size_t size) {
  known_.assign(size, 0);
  for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
    std::size_t slot = hash(program_.nodes[i]) & (size - 1);
    while (known_[slot] != 0) slot = (slot + 1) & (size - 1);
    known_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

ValueId Builder::intern(const Node& node) {
  if (2 * program_.nodes.size() >= known_.size()) grow(std::max(kSmallestTable, 2 * known_.size()));
  std::size_t slot = hash(node) & (known_.size() - 1);
  for (; known_[slot] != 0; slot = (slot + 1) & (known_.size() - 1))
    if (program_.nodes[known_[slot] - 1] == node) return ValueId(known_[slot] - 1);
  program_.nodes.push_back(node);
  program_.labels.emplace_back();
  known_[slot] = static_cast<std::uint32_t>(program_.nodes.size());
  return ValueId(program_.nodes.size() - 1);
}

cln::cl_R Builder::literal_of(Signed a) const {
  const cln::cl_R value = exact_literal(program_[a.value]);
  return a.negative ? -value : value;
}

bool Builder::is_literal(Signed a) const {
  const Node& node = program_[a.value];
  return node.op == Op::kLiteral && std::isfinite(node.literal);
}

bool Builder::is_literal(Signed a, double value) const {
  if (!is_literal(a)) return false;
  const Node& node = program_[a.value];
  return (a.negative ? -node.literal : node.literal) == value && node.tail[0] == 0;
}

Signed Builder::literal(double value) {
  const bool negative = value < 0;
  return {intern({.op = Op::kLiteral, .literal = std::fabs(value)}), negative};
}

Signed Builder::literal(const cln::cl_R& value) {
  const bool negative = cln::minusp(value);
  std::array<double, 4> parts = support::split(negative ? -value : value);
  if (std::fabs(parts[1]) < kRounding * parts[0]) parts = {parts[0], 0, 0, 0};
  return {intern({.op = Op::kLiteral, .literal = parts[0], .tail = {parts[1], parts[2], parts[3]}}),
          negative};
}

Signed Builder::leaf(LeafKind kind, std::size_t index) {
  return {intern({.op = Op::kLeaf, .leaf = kind, .index = static_cast<std::uint32_t>(index)}), false};
}

Signed Builder::add(Signed a, Signed b) {
  if (is_literal(a, 0)) return b;
  if (is_literal(b, 0)) return a;
  if (a.value == b.value && a.negative != b.negative) return literal(0);
  if (is_literal(a) && is_literal(b)) return literal(sum_of(literal_of(a), literal_of(b)));
  if (a.negative == b.negative) {
    if (b.value < a.value) std::swap(a, b);
    return {intern({.op = Op::kAdd, .a = a.value, .b = b.value}), a.negative};
  }
  // One canonical form of a difference: the operand declared first is positive, the sign moves outward.
  if (b.value < a.value) std::swap(a, b);
  return {intern({.op = Op::kSubtract, .a = a.value, .b = b.value}), a.negative};
}

Signed Builder::multiply(Signed a, Signed b) {
  if (is_literal(a, 0) || is_literal(b, 0)) return literal(0);
  if (is_literal(a) && is_literal(b)) return literal(literal_of(a) * literal_of(b));
  const bool negative = a.negative != b.negative;
  a.negative = b.negative = false;
  if (is_literal(a, 1)) return {b.value, negative};
  if (is_literal(b, 1)) return {a.value, negative};
  if (b.value < a.value) std::swap(a, b);
  return {intern({.op = Op::kMultiply, .a = a.value, .b = b.value}), negative};
}

Signed Builder::divide(Signed a, Signed b) {
  if (is_literal(a, 0) && !is_literal(b, 0)) return literal(0);
  if (is_literal(a) && is_literal(b) && !is_literal(b, 0)) return literal(literal_of(a) / literal_of(b));
  const bool negative = a.negative != b.negative;
  a.negative = b.negative = false;
  if (is_literal(b, 1)) return {a.value, negative};
  return {intern({.op = Op::kDivide, .a = a.value, .b = b.value}), negative};
}

/// The sign as an operation of its own, for operands from which it cannot be pulled.
ValueId Builder::with_its_sign(Signed a) {
  return a.negative ? intern({.op = Op::kNegate, .a = a.value}) : a.value;
}

Signed Builder::atan2(Signed a, Signed b) {
  if (is_literal(a, 0) && is_literal(b) && literal_of(b) > 0) return literal(0);
  const ValueId opposite = with_its_sign(a), adjacent = with_its_sign(b);
  return {intern({.op = Op::kAtan2, .a = opposite, .b = adjacent}), false};
}

Signed Builder::function(support::Function function, Signed a, Signed b) {
  using support::Function;
  if (function == Function::kAtan2) return atan2(a, b);
  const bool takes = function == Function::kWhereNegative || function == Function::kWhereNotNegative;
  if (takes) {
    const bool is_negative = is_literal(a) && cln::minusp(literal_of(a));
    if (is_literal(a)) return is_negative == (function == Function::kWhereNegative) ? b : literal(0);
    if (is_literal(b, 0)) return b;
    const ValueId condition = with_its_sign(a);
    return {intern({.op = op_of(function), .a = condition, .b = b.value}), b.negative};
  }
  if (support::facts_of(function).operands == 1) {
    const bool is_odd = function == Function::kSinh || function == Function::kTanh;
    const bool is_even = function == Function::kCosh || function == Function::kAbs;
    const ValueId argument = is_odd || is_even ? a.value : with_its_sign(a);
    return {intern({.op = op_of(function), .a = argument}), is_odd && a.negative};
  }
  const ValueId first = with_its_sign(a), second = with_its_sign(b);
  return {intern({.op = op_of(function), .a = first, .b = second}), false};
}

Signed Builder::unary(Op op, Signed a) {
  switch (op) {
    case Op::kNegate:
      return -a;
    case Op::kSin:
      if (is_literal(a, 0)) return literal(0);
      return {intern({.op = op, .a = a.value}), a.negative};
    case Op::kCos:
      if (is_literal(a, 0)) return literal(1);
      return {intern({.op = op, .a = a.value}), false};
    case Op::kSqrt:
      return {intern({.op = op, .a = with_its_sign(a)}), false};
    case Op::kLiteral:
    case Op::kLeaf:
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
    case Op::kDivide:
    default:
      break;
  }
  JD_CHECK(false, "{} is not unary", op_name(op));
  return a;
}

Signed Builder::apply(const Node& node, Signed a, Signed b) {
  switch (node.op) {
    case Op::kLiteral: {
      const bool negative = node.literal < 0;
      return {intern(negative ? negated(node) : node), negative};
    }
    case Op::kLeaf:
      return leaf(node.leaf, node.index);
    case Op::kAdd:
      return add(a, b);
    case Op::kSubtract:
      return subtract(a, b);
    case Op::kMultiply:
      return multiply(a, b);
    case Op::kDivide:
      return divide(a, b);
    case Op::kNegate:
    case Op::kSqrt:
    case Op::kSin:
    case Op::kCos:
      return unary(node.op, a);
    default:
      return function(function_of(node.op), a, b);
  }
}

void Builder::label(ValueId value, const std::string& name) {
  std::string& label = program_.labels[value.value];
  if (label.empty()) label = name;
}

void Builder::output(const std::string& name, int row, int column, Signed value) {
  if (value.negative) {
    const Node& node = program_[value.value];
    value.value =
        node.op == Op::kLiteral ? intern(negated(node)) : intern({.op = Op::kNegate, .a = value.value});
  }
  program_.outputs.push_back({name, row, column, value.value});
}

Program Builder::finish(std::string name) {
  program_.name = std::move(name);
  return std::move(program_);
}

}  // namespace jourdain::ir
