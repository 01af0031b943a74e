#include "mutants/exact_values.hpp"

#include <cln/cln.h>

#include <limits>

#include "support/scaled_real.hpp"

namespace jourdain::tests {

using ir::Node;
using ir::Op;

namespace {

cln::cl_R in_digits(const cln::cl_R& value) { return cln::cl_float(value, cln::float_format(60)); }

/// The value of a node; none where it has none.
std::optional<Exact> value(const Node& node, const std::vector<Exact>& values,
                           const ir::LeafValues<Exact>& leaves) {
  const Exact a = values.empty() ? Exact(0) : values[node.a.value],
              b = values.empty() ? Exact(0) : values[node.b.value];
  switch (node.op) {
    case Op::kLiteral:
      return in_digits(ir::exact_literal(node));
    case Op::kLeaf:
      return leaves[node.leaf].at(node.index);
    case Op::kNegate:
      return -a;
    case Op::kAdd:
      return a + b;
    case Op::kSubtract:
      return a - b;
    case Op::kMultiply:
      return a * b;
    case Op::kDivide:
      return cln::zerop(b) ? std::nullopt : std::optional<Exact>(a / b);
    case Op::kSqrt:
      return cln::minusp(a) ? std::nullopt : std::optional<Exact>(cln::sqrt(a));
    case Op::kSin:
      return cln::sin(a);
    case Op::kCos:
      return cln::cos(a);
    case Op::kAtan2:
      return cln::zerop(a) && cln::zerop(b) ? std::nullopt : std::optional<Exact>(cln::atan(b, a));
    default:
      return std::nullopt;  // no mutated scene has other functions
  }
  return {};
}

}  // namespace

ir::LeafValues<Exact> to_exact(const ir::LeafValues<double>& leaves) {
  ir::LeafValues<Exact> exact;
  for (std::size_t k = 0; k < ir::kLeafKinds; ++k)
    for (const double v : leaves.of[k]) exact.of[k].push_back(in_digits(support::to_exact(v)));
  return exact;
}

std::optional<std::vector<Exact>> exact_nodes(const ir::Program& program,
                                              const ir::LeafValues<Exact>& leaves) {
  std::vector<Exact> values;
  for (const Node& node : program.nodes) {
    const std::optional<Exact> next = value(node, values, leaves);
    if (!next) return {};
    values.push_back(*next);
  }
  return values;
}

std::vector<Exact> outputs_of(const ir::Program& program, const std::vector<Exact>& nodes) {
  std::vector<Exact> outputs;
  for (const ir::Output& output : program.outputs) outputs.push_back(nodes[output.value.value]);
  return outputs;
}

std::optional<std::vector<Exact>> exact_values(const ir::Program& program,
                                               const ir::LeafValues<Exact>& leaves) {
  const auto nodes = exact_nodes(program, leaves);
  return nodes ? std::optional(outputs_of(program, *nodes)) : std::nullopt;
}

double apart(const std::vector<Exact>& a, const std::vector<Exact>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  Exact difference = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = cln::max(difference, cln::abs(a[i] - b[i]));
    size = cln::max(size, cln::abs(a[i]));
  }
  if (cln::zerop(difference)) return 0;
  return cln::zerop(size) ? std::numeric_limits<double>::infinity()
                          : support::nearest_double(difference / size);
}

}  // namespace jourdain::tests
