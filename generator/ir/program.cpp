#include "ir/program.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>

namespace jourdain::ir {

cln::cl_R exact_literal(const Node& node) { return support::joined(node.literal, node.tail); }

int operand_count(Op op) {
  switch (op) {
    case Op::kLiteral:
    case Op::kLeaf:
      return 0;
    case Op::kNegate:
    case Op::kSqrt:
    case Op::kSin:
    case Op::kCos:
      return 1;
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
    case Op::kDivide:
      return 2;
    default:
      return support::facts_of(function_of(op)).operands;
  }
}

const char* op_name(Op op) {
  switch (op) {
    case Op::kLiteral:
      return "literal";
    case Op::kLeaf:
      return "leaf";
    case Op::kNegate:
      return "neg";
    case Op::kAdd:
      return "add";
    case Op::kSubtract:
      return "sub";
    case Op::kMultiply:
      return "mul";
    case Op::kDivide:
      return "div";
    case Op::kSqrt:
      return "sqrt";
    case Op::kSin:
      return "sin";
    case Op::kCos:
      return "cos";
    default:
      return support::facts_of(function_of(op)).name.data();
  }
}

const char* leaf_name(LeafKind kind) {
  switch (kind) {
    case LeafKind::kParameter:
      return "parameter";
    case LeafKind::kConstant:
      return "constant";
    case LeafKind::kPosition:
      return "y";
    case LeafKind::kVelocity:
      return "z";
    case LeafKind::kAcceleration:
      return "zdot";
    case LeafKind::kMultiplier:
      return "lambda";
    case LeafKind::kInput:
      return "u";
    case LeafKind::kTime:
      return "t";
    case LeafKind::kStepLength:
      return "h";
    case LeafKind::kHeld:
      return "held";
  }
  return "";
}

Operations count_operations(const Program& program) {
  Operations count;
  for (const Node& node : program.nodes) switch (node.op) {
      case Op::kLiteral:
      case Op::kLeaf:
      case Op::kArgument:
        break;
      case Op::kNegate:
        ++count.negate;
        break;
      case Op::kAdd:
        ++count.add;
        break;
      case Op::kSubtract:
        ++count.subtract;
        break;
      case Op::kMultiply:
        ++count.multiply;
        break;
      case Op::kDivide:
        ++count.divide;
        break;
      case Op::kSqrt:
        ++count.sqrt;
        break;
      case Op::kSin:
        ++count.sin;
        break;
      case Op::kCos:
        ++count.cos;
        break;
      case Op::kAtan2:
        ++count.atan2;
        break;
      default:
        ++(is_selection(node.op) ? count.selections : count.functions);
        break;
    }
  return count;
}

std::string print(const Program& program) {
  std::string text = fmt::format("program {}\n", program.name);
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const Node& node = program.nodes[i];
    text += fmt::format("%{}{}{} = ", i, program.labels[i].empty() ? "" : " ", program.labels[i]);
    if (node.op == Op::kLiteral)
      text += fmt::format("{}\n", node.literal);
    else if (node.op == Op::kLeaf)
      text += fmt::format("{}[{}]\n", leaf_name(node.leaf), node.index);
    else if (operand_count(node.op) == 1)
      text += fmt::format("{} %{}\n", op_name(node.op), node.a.value);
    else
      text += fmt::format("{} %{} %{}\n", op_name(node.op), node.a.value, node.b.value);
  }
  for (const Output& output : program.outputs) {
    text += output.name;
    if (output.row >= 0) text += fmt::format("[{}]", output.row);
    if (output.column >= 0) text += fmt::format("[{}]", output.column);
    text += fmt::format(" := %{}\n", output.value.value);
  }
  return text;
}

std::vector<std::size_t> use_counts(const Program& program) {
  std::vector<std::size_t> uses(program.nodes.size(), 0);
  for (const Node& node : program.nodes) {
    if (operand_count(node.op) >= 1) ++uses[node.a.value];
    if (operand_count(node.op) == 2) ++uses[node.b.value];
  }
  for (const Output& output : program.outputs) ++uses[output.value.value];
  return uses;
}

namespace {

template <class Real>
Real literal_value(const Node& node) {
  if constexpr (std::is_same_v<Real, support::ScaledReal>)
    return std::isfinite(node.literal) ? Real(exact_literal(node)) : Real::not_a_number();
  else
    return static_cast<Real>(node.literal);
}

}  // namespace

template <class Real>
Real computed(const Node& node, const std::vector<Real>& earlier) {
  using std::cos, std::sin, std::sqrt;
  JD_CHECK(node.op != Op::kLeaf, "{}[{}] has no value of its own", leaf_name(node.leaf), node.index);
  const auto a = [&]() -> const Real& { return earlier[node.a.value]; };
  const auto b = [&]() -> const Real& { return earlier[node.b.value]; };
  switch (node.op) {
    case Op::kLiteral:
      return literal_value<Real>(node);
    case Op::kNegate:
      return -a();
    case Op::kAdd:
      return a() + b();
    case Op::kSubtract:
      return a() - b();
    case Op::kMultiply:
      return a() * b();
    case Op::kDivide:
      return a() / b();
    case Op::kSqrt:
      return sqrt(a());
    case Op::kSin:
      return sin(a());
    case Op::kCos:
      return cos(a());
    default:
      return support::value_of(function_of(node.op), a(), b());
  }
}

template <class Real>
std::vector<Real> interpret(const Program& program, const LeafValues<Real>& leaves) {
  std::vector<Real> v;
  v.reserve(program.nodes.size());
  for (const Node& node : program.nodes) {
    if (node.op != Op::kLeaf) {
      v.push_back(computed(node, v));
      continue;
    }
    JD_CHECK(node.index < leaves[node.leaf].size(), "{}[{}]", leaf_name(node.leaf), node.index);
    v.push_back(leaves[node.leaf][node.index]);
  }
  std::vector<Real> results;
  for (const Output& output : program.outputs) results.push_back(v[output.value.value]);
  return results;
}

template support::ScaledReal computed(const Node&, const std::vector<support::ScaledReal>&);
template std::vector<float> interpret(const Program&, const LeafValues<float>&);
template std::vector<double> interpret(const Program&, const LeafValues<double>&);
template std::vector<long double> interpret(const Program&, const LeafValues<long double>&);
template std::vector<support::ScaledReal> interpret(const Program&, const LeafValues<support::ScaledReal>&);

}  // namespace jourdain::ir
