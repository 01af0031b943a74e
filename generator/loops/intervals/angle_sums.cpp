#include "loops/intervals/angle_sums.hpp"

#include <map>
#include <optional>

#include "ir/builder.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using ir::LeafKind;
using ir::Node;
using ir::Op;

namespace {

/// A sum of positions and one literal at most.
struct Sum {
  std::optional<double> offset;
  std::map<std::size_t, double> terms;
};

std::optional<Sum> added(const std::optional<Sum>& a, const std::optional<Sum>& b, double sign) {
  if (!a || !b || (a->offset && b->offset)) return {};
  Sum sum = *a;
  if (b->offset) sum.offset = sign * *b->offset;
  for (const auto& [position, factor] : b->terms) sum.terms[position] += sign * factor;
  return sum;
}

std::optional<Sum> sum_of(const Node& node, const std::vector<std::optional<Sum>>& sums) {
  const auto a = [&] { return sums[node.a.value]; };
  const auto b = [&] { return sums[node.b.value]; };
  if (node.op == Op::kLiteral) return Sum{node.literal, {}};
  if (node.op == Op::kLeaf && node.leaf == LeafKind::kPosition) return Sum{{}, {{node.index, 1.0}}};
  if (node.op == Op::kNegate) return added(Sum{}, a(), -1);
  if (node.op == Op::kAdd) return added(a(), b(), 1);
  if (node.op == Op::kSubtract) return added(a(), b(), -1);
  return {};
}

}  // namespace

SummedAngles with_summed_angles(const ir::Program& program, std::size_t first) {
  ir::Builder builder;
  SummedAngles result;
  std::vector<std::optional<Sum>> sums;
  std::vector<ir::Signed> copy;
  std::map<ir::ValueId, std::size_t> known;
  for (const Node& node : program.nodes) {
    const int operands = ir::operand_count(node.op);
    ir::Signed a = operands >= 1 ? copy[node.a.value] : ir::Signed{};
    const bool is_wave = node.op == Op::kSin || node.op == Op::kCos;
    if (is_wave && sums[node.a.value] && sums[node.a.value]->terms.size() > 1) {
      const auto [it, is_new] = known.try_emplace(node.a, first + result.sums.size());
      const Sum& sum = *sums[node.a.value];
      if (is_new) result.sums.push_back({sum.offset.value_or(0), {sum.terms.begin(), sum.terms.end()}});
      a = builder.leaf(LeafKind::kPosition, it->second);
    }
    sums.push_back(sum_of(node, sums));
    copy.push_back(builder.apply(node, a, operands == 2 ? copy[node.b.value] : ir::Signed{}));
  }
  for (const ir::Output& output : program.outputs)
    builder.output(output.name, output.row, output.column, copy[output.value.value]);
  result.program = passes::remove_dead_code(builder.finish(program.name));
  return result;
}

}  // namespace jourdain::loops
