#include "passes/angles.hpp"

#include <map>
#include <optional>

#include "ir/fixed_values.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::passes {

using ir::Builder;
using ir::Node;
using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

namespace {

class Splitting {
 public:
  explicit Splitting(const Program& program)
      : program_(program), fixed_(ir::fixed_values(program)), copy_(program) {}

  Program run() {
    return remove_dead_code(copy_.run([this](ValueId id) -> std::optional<Signed> {
      const Node& node = program_[id];
      if ((node.op != Op::kSin && node.op != Op::kCos) || !is_sum(node.a)) return {};
      const Pair pair = pair_of(node.a);
      return node.op == Op::kSin ? pair.sine : pair.cosine;
    }));
  }

 private:
  struct Pair {
    Signed sine, cosine;
  };

  bool is_sum(ValueId id) const {
    const Node& node = program_[id];
    return (node.op == Op::kAdd || node.op == Op::kSubtract) && !fixed_[node.a.value] &&
           !fixed_[node.b.value];
  }

  /// Runs of parallel joints are sums of sums: each partial sum is split once.
  Pair pair_of(ValueId id) {
    if (const auto known = pairs_.find(id); known != pairs_.end()) return known->second;
    const Node& node = program_[id];
    Builder& builder = copy_.builder();
    Pair pair;
    if (is_sum(id)) {
      const Pair a = pair_of(node.a);
      Pair b = pair_of(node.b);
      if (node.op == Op::kSubtract) b.sine = -b.sine;
      // One after the other: with every compiler in the same order.
      const Signed across = builder.multiply(a.cosine, b.sine), along = builder.multiply(a.sine, b.cosine);
      pair.sine = builder.add(along, across);
      const Signed of_sines = builder.multiply(a.sine, b.sine),
                   of_cosines = builder.multiply(a.cosine, b.cosine);
      pair.cosine = builder.subtract(of_cosines, of_sines);
    } else {
      pair = {builder.unary(Op::kSin, copy_[id]), builder.unary(Op::kCos, copy_[id])};
    }
    return pairs_[id] = pair;
  }

  const Program& program_;
  std::vector<bool> fixed_;
  Copy copy_;
  std::map<ValueId, Pair> pairs_;
};

}  // namespace

Program split_angles(const Program& program) {
  return settled(program, [](const Program& p) { return Splitting(p).run(); });
}

}  // namespace jourdain::passes
