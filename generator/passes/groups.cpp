#include "passes/groups.hpp"

#include <utility>

namespace jourdain::passes {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::ValueId;

namespace {

bool is_sum(Op op) { return op == Op::kAdd || op == Op::kSubtract; }

}  // namespace

Groups::Groups(const Program& program, const std::vector<bool>& apart)
    : groups_(program.nodes.size()), within_(program.nodes.size()), users_(program.nodes.size()) {
  const std::vector<std::size_t> uses = ir::use_counts(program);
  std::vector<bool> is_output(program.nodes.size());
  for (const ir::Output& output : program.outputs) is_output[output.value.value] = true;
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const Node& node = program.nodes[i];
    const int operands = ir::operand_count(node.op);
    if (operands == 0) continue;
    Group group{is_sum(node.op) ? Op::kAdd : node.op, {}};
    for (int k = 0; k < operands; ++k) {
      const ValueId operand = k == 0 ? node.a : node.b;
      const bool negative = node.op == Op::kSubtract && k == 1;
      const std::optional<Group>& inner = groups_[operand.value];
      const bool joins = inner && inner->op == group.op && uses[operand.value] == 1 &&
                         !is_output[operand.value] && (apart.empty() || !apart[operand.value]) &&
                         (group.op == Op::kAdd || group.op == Op::kMultiply);
      if (!joins) {
        group.terms.push_back({operand, negative});
        continue;
      }
      within_[operand.value] = true;
      for (const Term& term : inner->terms) group.terms.push_back({term.value, term.negative != negative});
    }
    groups_[i] = std::move(group);
  }
  for (std::size_t i = 0; i < program.nodes.size(); ++i)
    if (within_[i]) groups_[i].reset();
  for (std::size_t i = 0; i < program.nodes.size(); ++i)
    if (groups_[i])
      for (const Term& term : groups_[i]->terms)
        if (users_[term.value.value].empty() || users_[term.value.value].back() != ValueId(i))
          users_[term.value.value].push_back(ValueId(i));
}

}  // namespace jourdain::passes
