#include "passes/rewrite.hpp"

namespace jourdain::passes {

using ir::Builder;
using ir::Node;
using ir::Program;
using ir::Signed;

std::vector<bool> needed_values(const Program& program) {
  std::vector<bool> needed(program.nodes.size(), false);
  for (const ir::Output& output : program.outputs) needed[output.value.value] = true;
  for (std::size_t i = program.nodes.size(); i-- > 0;) {
    if (!needed[i]) continue;
    const Node& node = program.nodes[i];
    if (ir::operand_count(node.op) >= 1) needed[node.a.value] = true;
    if (ir::operand_count(node.op) == 2) needed[node.b.value] = true;
  }
  return needed;
}

Program remove_dead_code(const Program& program) {
  const std::vector<bool> needed = needed_values(program);
  Builder builder;
  std::vector<Signed> copy(program.nodes.size());
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    if (!needed[i]) continue;
    const Node& node = program.nodes[i];
    copy[i] = builder.apply(node, copy[node.a.value], copy[node.b.value]);
    if (!program.labels[i].empty()) builder.label(copy[i].value, program.labels[i]);
  }
  for (const ir::Output& output : program.outputs)
    builder.output(output.name, output.row, output.column, copy[output.value.value]);
  return builder.finish(program.name);
}

}  // namespace jourdain::passes
