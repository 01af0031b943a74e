#include "ir/fixed_values.hpp"

namespace jourdain::ir {

bool is_made_with_the_model(LeafKind kind, std::size_t /*index*/) {
  return kind == LeafKind::kParameter || kind == LeafKind::kConstant;
}

std::vector<bool> fixed_values(const Program& program,
                               const std::function<bool(LeafKind, std::size_t)>& is_fixed) {
  std::vector<bool> fixed;
  for (const Node& node : program.nodes) {
    const int operands = operand_count(node.op);
    fixed.push_back(operands == 0 ? node.op == Op::kLiteral || is_fixed(node.leaf, node.index)
                                  : fixed[node.a.value] && (operands == 1 || fixed[node.b.value]));
  }
  return fixed;
}

}  // namespace jourdain::ir
