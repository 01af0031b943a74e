#include "passes/value_order.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "passes/rewrite.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::ValueId;

namespace {

class Processor {
 public:
  explicit Processor(const Program& program)
      : program_(program), fused_(program.nodes.size(), false), done_(program.nodes.size(), 0) {
    const std::vector<std::size_t> uses = ir::use_counts(program);
    const auto takes_up = [&](ValueId term) {
      fused_[term.value] = program[term].op == Op::kMultiply && uses[term.value] == 1;
      return fused_[term.value];
    };
    for (const Node& node : program.nodes)
      if ((node.op == Op::kAdd || node.op == Op::kSubtract) && !takes_up(node.a)) takes_up(node.b);
  }

  std::size_t cycles() {
    for (std::size_t i = 0; i < program_.nodes.size(); ++i)
      if (!is_given(program_.nodes[i].op) && !fused_[i]) begin(i);
    return retired_.empty() ? 0 : retired_.back();
  }

 private:
  struct Kind {
    std::size_t latency, occupied;  ///< cycles
  };
  static constexpr std::size_t kBegun = 2, kInFlight = 160;

  /// About those of processors of 2020 to 2024 for numbers of 64 bits (Fog, "Instruction tables").
  static Kind kind_of(Op op) {
    if (op == Op::kDivide) return {14, 5};
    if (op == Op::kSqrt) return {20, 8};
    if (op == Op::kNegate) return {1, 1};
    return ir::is_function(op) && !ir::is_selection(op) ? Kind{50, 20} : Kind{4, 1};
  }

  static bool is_given(Op op) { return ir::operand_count(op) == 0 || op == Op::kSin || op == Op::kCos; }

  void begin(std::size_t i) {
    const Kind kind = kind_of(program_.nodes[i].op);
    std::size_t cycle = std::max(there(i), retired_.size() / kBegun);
    if (retired_.size() >= kInFlight) cycle = std::max(cycle, retired_[retired_.size() - kInFlight]);
    while (begun_at(cycle) >= kBegun) ++cycle;
    for (std::size_t k = 0; k < kind.occupied; ++k) ++begun_at(cycle + k);
    done_[i] = cycle + kind.latency;
    retired_.push_back(std::max(done_[i], retired_.empty() ? 0 : retired_.back()));
  }

  /// When all that it needs is there.
  std::size_t there(std::size_t i) const {
    const Node& node = program_.nodes[i];
    std::size_t latest = 0;
    for (int k = 0; k < ir::operand_count(node.op); ++k) {
      const std::size_t needed = (k == 0 ? node.a : node.b).value;
      latest = std::max(latest, fused_[needed] ? there(needed) : done_[needed]);
    }
    return latest;
  }

  std::size_t& begun_at(std::size_t cycle) {
    if (cycle >= begun_.size()) begun_.resize(2 * cycle + 64, 0);
    return begun_[cycle];
  }

  const Program& program_;
  std::vector<bool> fused_;
  /// Of each value when it is there; of each operation that was begun when it and all before it are; of each cycle how
  /// many operations begin.
  std::vector<std::size_t> done_, retired_, begun_;
};

/// Operands, that which keeps more numbers first.
struct Needs {
  std::array<ValueId, 2> values;
  int count = 0;
};

std::vector<Needs> needs_of(const Program& program) {
  std::vector<Needs> all(program.nodes.size());
  // Numbers that the walk to each value keeps at a time, were nothing shared; leaves are read where needed.
  std::vector<int> kept(program.nodes.size(), 0);
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const Node& node = program.nodes[i];
    Needs& needs = all[i];
    needs = {{node.a, node.b}, ir::operand_count(node.op)};
    if (needs.count == 2 && kept[node.b.value] > kept[node.a.value])
      std::swap(needs.values[0], needs.values[1]);
    if (needs.count > 0) kept[i] = std::max(1, kept[needs.values[0].value]);
    if (needs.count == 2) kept[i] = std::max(kept[i], kept[needs.values[1].value] + 1);
  }
  return all;
}

/// Values that the roots need, each after what it needs.
std::vector<ValueId> walk(const std::vector<ValueId>& roots, const std::vector<Needs>& needs) {
  std::vector<ValueId> order;
  std::vector<bool> seen(needs.size(), false);
  std::vector<std::pair<ValueId, int>> path;  // and how many of its needs were entered
  const auto enter = [&](ValueId value) {
    if (seen[value.value]) return;
    seen[value.value] = true;
    path.emplace_back(value, 0);
  };
  for (const ValueId root : roots) {
    enter(root);
    while (!path.empty()) {
      const ValueId value = path.back().first;
      if (const int entered = path.back().second++; entered < needs[value.value].count) {
        enter(needs[value.value].values[static_cast<std::size_t>(entered)]);
      } else {
        order.push_back(value);
        path.pop_back();
      }
    }
  }
  return order;
}

}  // namespace

std::size_t estimated_cycles(const Program& program) { return Processor(program).cycles(); }

Program order_values(const Program& program) {
  if (!program.lanes.empty()) return program;
  const std::vector<Needs> needs = needs_of(program);
  std::vector<ValueId> roots;
  for (const ir::Output& output : program.outputs) roots.push_back(output.value);
  Program best = program;
  const std::size_t given = estimated_cycles(program);
  std::size_t least = given - given / 25;  // less than that is beyond the model
  for (int k = 0; k < 2; ++k) {
    Program walked = in_order(program, walk(roots, needs));
    if (const std::size_t cycles = estimated_cycles(walked); cycles < least) {
      least = cycles;
      best = std::move(walked);
    }
    std::reverse(roots.begin(), roots.end());
  }
  return best;
}

}  // namespace jourdain::passes
