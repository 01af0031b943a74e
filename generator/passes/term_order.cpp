#include "passes/term_order.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "passes/association.hpp"
#include "passes/groups.hpp"
#include "passes/rewrite.hpp"
#include "passes/sampled_rounding.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

namespace {

constexpr std::size_t kJoin = 4;  ///< of a sum or product

/// Cycles from operands to result, about; those of x86-64 and AArch64 cores are near each other.
std::size_t latency(Op op) {
  switch (op) {
    case Op::kLiteral:
    case Op::kLeaf:
    case Op::kArgument:
      return 0;
    case Op::kNegate:
      return 1;
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
      return kJoin;
    case Op::kDivide:
      return 14;
    case Op::kSqrt:
      return 20;
    default:
      return ir::is_selection(op) ? kJoin : 50;
  }
}

bool has_order(const Group& group) {
  return group.terms.size() > 2 && (group.op == Op::kAdd || group.op == Op::kMultiply);
}

/// Of an association: when each place is there, where terms are there when `depths` says.
std::vector<std::size_t> depths_of_places(const Association& association, std::vector<std::size_t> depths) {
  for (const auto& [a, b] : association.steps) depths.push_back(std::max(depths[a], depths[b]) + kJoin);
  return depths;
}

class Ordering {
 public:
  Ordering(const Program& program, const std::vector<bool>& apart)
      : program_(program),
        apart_(apart),
        groups_(program, apart),
        depth_(program.nodes.size()),
        rounding_(program),
        chosen_(program.nodes.size()) {}

  Reordered run() {
    for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
      const ValueId value(i);
      rounding_.follow(value, Definition());
      if (groups_.is_within(value)) continue;
      const Group* group = groups_.at(value);
      if (!group || !has_order(*group)) {
        depth_[i] = own_depth(value);
        continue;
      }
      chosen_[i] = chosen(value, *group);
      rounding_.follow(value, group->op, *chosen_[i]);
      depth_[i] = depth_of(*chosen_[i]);
    }
    return built();
  }

 private:
  std::size_t own_depth(ValueId value) const {
    const Node& node = program_[value];
    const int operands = ir::operand_count(node.op);
    std::size_t depth = operands > 0 ? depth_[node.a.value] : 0;
    if (operands > 1) depth = std::max(depth, depth_[node.b.value]);
    return depth + latency(node.op);
  }

  std::vector<std::size_t> depths_of_terms(const Association& association) const {
    std::vector<std::size_t> depths;
    for (const Signed& term : association.terms) depths.push_back(depth_[term.value.value]);
    return depths;
  }

  std::size_t depth_of(const Association& association) const {
    return depths_of_places(association, depths_of_terms(association)).back();
  }

  // Associations

  /// Always the two that are there first, so that the whole is there as early as can be (Huffman's construction).
  Association pair_by_pair(const Group& group) const {
    Association association;
    for (const Term& term : group.terms) association.terms.push_back({term.value, term.negative});
    const auto key = [this](const Signed& term) {
      return std::tuple(depth_[term.value.value], term.value, term.negative);
    };
    std::sort(association.terms.begin(), association.terms.end(),
              [&](const Signed& a, const Signed& b) { return key(a) < key(b); });
    const std::size_t count = association.terms.size();
    const std::vector<std::size_t> depths = depths_of_terms(association);
    std::set<std::pair<std::size_t, std::size_t>> waiting;  // when it is there, its place
    for (std::size_t i = 0; i < count; ++i) waiting.insert({depths[i], i});
    const auto first = [&] { return waiting.extract(waiting.begin()).value(); };
    for (std::size_t i = 1; i < count; ++i) {
      const std::size_t a = first().second;
      const auto [later, b] = first();
      waiting.insert({later + kJoin, association.join(a, b)});
    }
    return association;
  }

  Association as_written(ValueId root) const {
    Association association;
    for (const Term& term : groups_.at(root)->terms) association.terms.push_back({term.value, term.negative});
    std::size_t next = 0;
    write(root, association, next);
    return association;
  }

  /// Appends the steps of a value of a group whose terms from `next` on are its own; returns its place.
  std::size_t write(ValueId value, Association& association, std::size_t& next) const {
    const auto place = [&](ValueId operand) {
      return groups_.is_within(operand) ? write(operand, association, next) : next++;
    };
    const std::size_t a = place(program_[value].a), b = place(program_[value].b);
    return association.join(a, b);
  }

  /// Pair by pair, unless digits are lost.
  Association chosen(ValueId root, const Group& group) const {
    Association way = pair_by_pair(group);
    return rounding_.admits(root, group.op, way) ? way : as_written(root);
  }

  // The program

  Reordered built() {
    Copy copy(program_);
    std::vector<bool> within(program_.nodes.size());
    for (std::size_t i = 0; i < within.size(); ++i) within[i] = groups_.is_within(ValueId(i));
    Reordered result;
    result.program = copy.run(
        [&](ValueId value) -> std::optional<Signed> {
          const std::optional<Association>& association = chosen_[value.value];
          if (!association) return {};
          return places_in(copy, groups_.at(value)->op, *association).back();
        },
        within);
    result.apart.resize(result.program.nodes.size());
    for (std::size_t i = 0; i < apart_.size(); ++i)
      if (apart_[i]) result.apart[copy[ValueId(i)].value.value] = true;
    return result;
  }

  const Program& program_;
  const std::vector<bool>& apart_;
  Groups groups_;
  std::vector<std::size_t> depth_;
  SampledRounding rounding_;
  std::vector<std::optional<Association>> chosen_;
};

}  // namespace

Program order_terms(const Program& program) {
  return settled(program,
                 [](const Program& given) { return without_unused(Ordering(given, {}).run().program); });
}

Reordered order_terms(const Reordered& given) { return Ordering(given.program, given.apart).run(); }

}  // namespace jourdain::passes
