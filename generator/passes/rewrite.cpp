#include "passes/rewrite.hpp"

#include <algorithm>
#include <utility>

namespace jourdain::passes {

using ir::Node;
using ir::Program;
using ir::Signed;
using ir::ValueId;

Program Copy::run(const Rewritten& rewritten, const std::vector<bool>& left_out) {
  for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
    if (!left_out.empty() && left_out[i]) continue;
    const Node& node = program_.nodes[i];
    const std::optional<Signed> given = rewritten(ValueId(i));
    values_[i] = given ? *given : builder_.apply(node, (*this)[node.a], (*this)[node.b]);
    if (!program_.labels[i].empty()) builder_.label(values_[i].value, program_.labels[i]);
  }
  for (const ir::Output& output : program_.outputs)
    builder_.output(output.name, output.row, output.column, (*this)[output.value]);
  return builder_.finish(program_.name);
}

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

Program in_order(const Program& program, const std::vector<ir::ValueId>& order) {
  Program result;
  result.name = program.name;
  std::vector<ir::ValueId> place(program.nodes.size());
  for (const ir::ValueId value : order) {
    Node node = program[value];
    if (ir::operand_count(node.op) >= 1) node.a = place[node.a.value];
    if (ir::operand_count(node.op) == 2) node.b = place[node.b.value];
    place[value.value] = ir::ValueId(result.nodes.size());
    result.nodes.push_back(node);
    result.labels.push_back(program.labels[value.value]);
  }
  result.outputs = program.outputs;
  for (ir::Output& output : result.outputs) output.value = place[output.value.value];
  return result;
}

Program without_unused(const Program& program) {
  const std::vector<bool> needed = needed_values(program);
  std::vector<ir::ValueId> order;
  for (std::size_t i = 0; i < program.nodes.size(); ++i)
    if (needed[i]) order.emplace_back(i);
  return in_order(program, order);
}

namespace {

Program swept(const Program& program) {
  std::vector<bool> unused = needed_values(program);
  unused.flip();
  return without_unused(Copy(program).run([](ValueId) { return std::optional<Signed>(); }, unused));
}

bool same_outputs(const Program& a, const Program& b) {
  return std::equal(a.outputs.begin(), a.outputs.end(), b.outputs.begin(), b.outputs.end(),
                    [](const ir::Output& x, const ir::Output& y) { return x.value == y.value; });
}

}  // namespace

bool same_operations(const Program& a, const Program& b) { return a.nodes == b.nodes && same_outputs(a, b); }

Program settled(const Program& program, const Rewriting& rewrite) {
  constexpr int kMostRuns = 100;  // a cycle would cost idempotence, never correctness
  Program current = program, before;
  for (int run = 0; run < kMostRuns; ++run) {
    Program next = rewrite(current);
    // Two sums that are equal but for their order may change places for ever: the first of both is kept.
    if (same_operations(next, current) || (run > 0 && same_operations(next, before))) return next;
    before = std::exchange(current, std::move(next));
  }
  return current;
}

Program remove_dead_code(const Program& program) { return settled(program, swept); }

}  // namespace jourdain::passes
