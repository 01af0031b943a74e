#include "loops/rows/timeless.hpp"

#include <algorithm>
#include <map>

namespace jourdain::loops {

using ir::LeafKind;
using ir::Node;
using ir::Op;
using ir::Program;
using ir::ValueId;

namespace {

bool is_leaf(const Node& node, LeafKind kind) { return node.op == Op::kLeaf && node.leaf == kind; }

bool is_sum(Op op) { return op == Op::kAdd || op == Op::kSubtract || op == Op::kNegate; }

class Copy {
 public:
  Copy(ir::Builder& builder, const Program& program, std::size_t first)
      : builder_(builder),
        program_(program),
        first_(first),
        timed_(program.nodes.size(), false),
        placed_(timed_),
        copy_(program.nodes.size()) {}

  Timeless run() {
    for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
      const Node& node = program_.nodes[i];
      timed_[i] = is_leaf(node, LeafKind::kTime) || any_operand(node, timed_);
      placed_[i] = is_leaf(node, LeafKind::kPosition) || any_operand(node, placed_);
      const bool is_wave = node.op == Op::kSin || node.op == Op::kCos;
      const ir::Signed a = is_wave ? angle(node.a) : copy_[node.a.value];
      copy_[i] = builder_.apply(node, a, copy_[node.b.value]);
      if (is_wave) timed_[i] = false;
    }
    for (const ir::Output& output : program_.outputs) result_.values.push_back(copy_[output.value.value]);
    return result_;
  }

 private:
  static bool any_operand(const Node& node, const std::vector<bool>& marked) {
    const int operands = ir::operand_count(node.op);
    return (operands >= 1 && marked[node.a.value]) || (operands == 2 && marked[node.b.value]);
  }

  ir::Signed angle(ValueId id) {
    if (!timed_[id.value]) return copy_[id.value];
    const Node& node = program_[id];
    if (!placed_[id.value] || !is_sum(node.op)) return driven(id);
    if (node.op == Op::kNegate) return -angle(node.a);
    const ir::Signed a = angle(node.a), b = angle(node.b);
    return node.op == Op::kAdd ? builder_.add(a, b) : builder_.subtract(a, b);
  }

  ir::Signed driven(ValueId id) {
    result_.drives_with_positions = result_.drives_with_positions || placed_[id.value];
    auto& list = result_.driven;
    auto it = std::find(list.begin(), list.end(), id);
    if (it == list.end()) it = list.insert(it, id);
    return builder_.leaf(LeafKind::kPosition, first_ + static_cast<std::size_t>(it - list.begin()));
  }

  ir::Builder& builder_;
  const Program& program_;
  std::size_t first_;
  std::vector<bool> timed_, placed_;  ///< values that depend on time, on positions
  std::vector<ir::Signed> copy_;
  Timeless result_;
};

}  // namespace

Timeless without_clock(ir::Builder& builder, const Program& program, std::size_t first) {
  return Copy(builder, program, first).run();
}

bool is_periodic(const Program& program, std::size_t position) {
  std::vector<bool> turns(program.nodes.size(), false);
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const Node& node = program.nodes[i];
    const int operands = ir::operand_count(node.op);
    const bool operand_turns =
        (operands >= 1 && turns[node.a.value]) || (operands == 2 && turns[node.b.value]);
    turns[i] =
        (operand_turns && is_sum(node.op)) || (is_leaf(node, LeafKind::kPosition) && node.index == position);
    if (operand_turns && !is_sum(node.op) && node.op != Op::kSin && node.op != Op::kCos) return false;
  }
  return std::none_of(program.outputs.begin(), program.outputs.end(),
                      [&](const ir::Output& output) { return turns[output.value.value]; });
}

}  // namespace jourdain::loops
