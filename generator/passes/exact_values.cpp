#include "passes/exact_values.hpp"

#include "ir/scramble.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::ValueId;
using support::ScaledReal;

ExactValues::ExactValues(const ir::Program& program, std::uint64_t sample)
    : program_(program), sample_(sample), values_(program.nodes.size()), is_known_(program.nodes.size()) {}

ScaledReal ExactValues::computed(const Node& node) const {
  if (node.op != ir::Op::kLeaf) return ir::computed(node, values_);
  return 0.5 + ir::unit_of(ir::scrambled(ir::seed_of_leaf(node), sample_));
}

const ScaledReal& ExactValues::of(ValueId id) {
  std::vector<std::size_t> asked = {id.value};
  while (!asked.empty()) {
    const std::size_t i = asked.back(), before = asked.size();
    const Node& node = program_.nodes[i];
    const auto ask = [&](ValueId operand) {
      if (!is_known_[operand.value]) asked.push_back(operand.value);
    };
    if (!is_known_[i] && ir::operand_count(node.op) >= 1) ask(node.a);
    if (!is_known_[i] && ir::operand_count(node.op) == 2) ask(node.b);
    if (asked.size() > before) continue;
    if (!is_known_[i]) values_[i] = computed(node);
    is_known_[i] = true;
    asked.pop_back();
  }
  return values_[id.value];
}

}  // namespace jourdain::passes
