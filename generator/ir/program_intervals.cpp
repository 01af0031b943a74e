#include "ir/program_intervals.hpp"

namespace jourdain::ir {

using support::Interval;

namespace {

bool undefined(const Node& node, Interval a, Interval b) {
  switch (node.op) {
    case Op::kSqrt:
      return a.low < 0;
    case Op::kDivide:
      return b.contains(0);
    case Op::kAtan2:
      return a.contains(0) && b.contains(0);
    case Op::kLog:
      return a.low <= 0;
    case Op::kPower:
      return a.low < 0 || (a.contains(0) && b.low <= 0);
    case Op::kLiteral:
    case Op::kLeaf:
    case Op::kNegate:
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
    case Op::kSin:
    case Op::kCos:
    default:
      break;
  }
  return false;
}

Interval evaluated(const Node& node, Interval a, Interval b) {
  switch (node.op) {
    case Op::kLiteral:
    case Op::kLeaf:
      break;
    case Op::kNegate:
      return -a;
    case Op::kAdd:
      return a + b;
    case Op::kSubtract:
      return a - b;
    case Op::kMultiply:
      return node.a == node.b ? square(a) : a * b;
    case Op::kDivide:
      return a / b;
    case Op::kSqrt:
      return sqrt(a);
    case Op::kSin:
      return sin(a);
    case Op::kCos:
      return cos(a);
    default:
      return value_of(function_of(node.op), a, b);
  }
  return Interval::point(node.literal);
}

}  // namespace

IntervalResults interpret_interval(const Program& program, const LeafValues<Interval>& leaves) {
  const std::size_t count = program.nodes.size();
  std::vector<Interval> value(count);
  std::vector<char> maybe_undefined(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Node& node = program.nodes[i];
    if (node.op == Op::kLeaf) {
      JD_CHECK(node.index < leaves[node.leaf].size(), "{}[{}]", leaf_name(node.leaf), node.index);
      value[i] = leaves[node.leaf][node.index];
      continue;
    }
    const int operands = operand_count(node.op);
    const Interval a = operands >= 1 ? value[node.a.value] : Interval{},
                   b = operands == 2 ? value[node.b.value] : Interval{};
    value[i] = evaluated(node, a, b);
    maybe_undefined[i] = (operands >= 1 && maybe_undefined[node.a.value] != 0) ||
                         (operands == 2 && maybe_undefined[node.b.value] != 0) || undefined(node, a, b);
  }
  IntervalResults results;
  for (const Output& output : program.outputs) {
    results.values.push_back(value[output.value.value]);
    results.maybe_undefined.push_back(maybe_undefined[output.value.value] != 0);
  }
  return results;
}

}  // namespace jourdain::ir
