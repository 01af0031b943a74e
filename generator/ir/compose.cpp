#include "ir/compose.hpp"

namespace jourdain::ir {

std::vector<Signed> insert(Builder& builder, const Program& program, const LeafValue& leaf) {
  std::vector<Signed> copy(program.nodes.size());
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const Node& node = program.nodes[i];
    const std::optional<Signed> given =
        node.op == Op::kLeaf ? leaf(node.leaf, node.index) : std::optional<Signed>();
    copy[i] = given ? *given : builder.apply(node, copy[node.a.value], copy[node.b.value]);
    if (!program.labels[i].empty()) builder.label(copy[i].value, program.labels[i]);
  }
  std::vector<Signed> outputs;
  for (const Output& output : program.outputs) outputs.push_back(copy[output.value.value]);
  return outputs;
}

std::vector<Signed> insert(Builder& builder, const Program& program) {
  return insert(builder, program, [](LeafKind, std::size_t) { return std::optional<Signed>(); });
}

}  // namespace jourdain::ir
