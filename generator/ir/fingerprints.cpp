#include "ir/fingerprints.hpp"

#include <algorithm>
#include <cmath>

#include "ir/scramble.hpp"

namespace jourdain::ir {

namespace {

template <class Operation>
Fingerprint pointwise(const Fingerprint& a, const Fingerprint& b, Operation operation) {
  Fingerprint result;
  for (std::size_t k = 0; k < Fingerprint::kPoints; ++k) result.at[k] = operation(a.at[k], b.at[k]);
  return result;
}

Fingerprint everywhere(Residue value) { return {{value, value, value, value}}; }

Fingerprint random_element(std::uint64_t seed) {
  Fingerprint result;
  for (std::size_t k = 0; k < Fingerprint::kPoints; ++k) result.at[k] = Residue(scrambled(seed, k));
  return result;
}

std::uint64_t seed_of(Op op, const Fingerprint& argument, std::uint64_t state = 0) {
  state = scrambled(state, static_cast<std::uint64_t>(op));
  for (const Residue value : argument.at) state = scrambled(state, value.value());
  return state;
}

Fingerprint number(const Node& literal) {
  Residue sum = Residue::of(literal.literal);
  for (const double part : literal.tail) sum = sum + Residue::of(part);
  return everywhere(sum);
}

Fingerprint quotient(const Fingerprint& a, const Fingerprint& b) {
  return pointwise(a, b, [](Residue x, Residue y) { return x * y.inverse(); });
}

Fingerprint sine_or_cosine(Op op, const Fingerprint& angle) {
  const Fingerprint one = everywhere(Residue(1));
  if (angle.is_zero()) return op == Op::kCos ? one : Fingerprint();
  const bool negative = angle.is_negative();
  const Fingerprint t = random_element(seed_of(Op::kSin, negative ? -angle : angle)), tt = t * t,
                    result = quotient(op == Op::kSin ? t + t : one - tt, one + tt);
  return negative && op == Op::kSin ? -result : result;
}

Fingerprint evaluated(const Node& node, const Fingerprint& a, const Fingerprint& b) {
  switch (node.op) {
    case Op::kLiteral:
      return number(node);
    case Op::kLeaf:
      return random_element(seed_of_leaf(node));
    case Op::kNegate:
      return -a;
    case Op::kAdd:
      return a + b;
    case Op::kSubtract:
      return a - b;
    case Op::kMultiply:
      return a * b;
    case Op::kDivide:
      return quotient(a, b);
    case Op::kSqrt:
      return random_element(seed_of(node.op, a));
    case Op::kSin:
    case Op::kCos:
      return sine_or_cosine(node.op, a);
    default:
      return random_element(seed_of(node.op, a, operand_count(node.op) == 2 ? seed_of(node.op, b) : 0));
  }
}

}  // namespace

Fingerprint operator+(const Fingerprint& a, const Fingerprint& b) {
  return pointwise(a, b, [](Residue x, Residue y) { return x + y; });
}

Fingerprint operator-(const Fingerprint& a, const Fingerprint& b) {
  return pointwise(a, b, [](Residue x, Residue y) { return x - y; });
}

Fingerprint operator*(const Fingerprint& a, const Fingerprint& b) {
  return pointwise(a, b, [](Residue x, Residue y) { return x * y; });
}

std::optional<std::vector<Fingerprint>> fingerprints(const Program& program, const LeafFingerprint& leaf) {
  std::vector<Fingerprint> values;
  values.reserve(program.nodes.size());
  for (const Node& node : program.nodes) {
    const int operands = operand_count(node.op);
    const Fingerprint a = operands >= 1 ? values[node.a.value] : Fingerprint(),
                      b = operands == 2 ? values[node.b.value] : Fingerprint();
    if (node.op == Op::kLiteral && !std::isfinite(node.literal)) return {};
    if (node.op == Op::kDivide &&
        std::any_of(b.at.begin(), b.at.end(), [](Residue r) { return r.is_zero(); }))
      return {};
    const std::optional<Fingerprint> given =
        leaf && node.op == Op::kLeaf ? leaf(node.leaf, node.index) : std::nullopt;
    values.push_back(given ? *given : evaluated(node, a, b));
  }
  return values;
}

}  // namespace jourdain::ir
