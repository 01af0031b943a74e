#include "passes/lanes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "ir/builder.hpp"
#include "passes/lane_order.hpp"
#include "passes/limb_sums.hpp"
#include "support/check.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

namespace {

/// What bundles save, in operations, less what it costs to bring their terms together.
class Gain {
 public:
  Gain(const Program& program, const Groups& groups, const std::vector<LikeGroups>& bundles)
      : program_(program),
        groups_(groups),
        bundles_(bundles),
        kept_(bundles.size(), true),
        bundle_(program.nodes.size()) {
    for (std::size_t p = 0; p < bundles.size(); ++p)
      for (const LikeGroups::Lane& lane : bundles[p].lanes) bundle_[lane.root.value] = p;
  }

  /// Without those that do not pay.
  std::vector<LikeGroups> worthwhile() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t p = bundles_.size(); p-- > 0;)
        if (kept_[p] && 2 * saved(p) < cost(p)) {
          kept_[p] = false;
          changed = true;
        }
    }
    std::vector<LikeGroups> list;
    for (std::size_t p = 0; p < bundles_.size(); ++p)
      if (kept_[p]) list.push_back(bundles_[p]);
    return list;
  }

 private:
  std::size_t saved(std::size_t p) const {
    const LikeGroups::Lane& lane = bundles_[p].lanes[0];
    return (bundles_[p].lanes.size() - 1) * std::max<std::size_t>(lane.terms.size() - 1, 1);
  }

  bool is_kept(ValueId value) const { return bundle_[value.value] && kept_[*bundle_[value.value]]; }

  /// In halves of an operation: one for each lane but the first of a term that is gathered, two where it is read from
  /// other lanes for that; one for each lane but the first that is read alone.
  std::size_t cost(std::size_t p) const {
    const std::vector<LikeGroups::Lane>& lanes = bundles_[p].lanes;
    std::size_t sum = 0;
    for (std::size_t i = 0; i < lanes[0].terms.size(); ++i) {
      const ValueId first = lanes[0].terms[i].value;
      const bool is_shared = std::all_of(lanes.begin(), lanes.end(), [&](const LikeGroups::Lane& lane) {
        return lane.terms[i].value == first || program_[lane.terms[i].value].op == Op::kLiteral;
      });
      const bool is_angle =
          program_[first].op == Op::kSin || program_[first].op == Op::kCos;  // gathered once
      if (is_shared || is_angle || stands_in_lanes(lanes, i)) continue;
      for (std::size_t l = 1; l < lanes.size(); ++l) sum += is_kept(lanes[l].terms[i].value) ? 2 : 1;
    }
    for (const LikeGroups::Lane& lane : lanes) {
      const std::vector<ValueId>& users = groups_.users(lane.root);
      const bool is_first = lane.root == lanes[0].root;  // which is read as it is
      if (!is_first && (users.empty() || !std::all_of(users.begin(), users.end(),
                                                      [&](ValueId user) { return is_kept(user); })))
        ++sum;
    }
    return sum;
  }

  /// Are the terms `i` of all lanes lanes of one bundle, in their order?
  bool stands_in_lanes(const std::vector<LikeGroups::Lane>& lanes, std::size_t i) const {
    if (!is_kept(lanes[0].terms[i].value)) return false;
    const std::vector<LikeGroups::Lane>& of = bundles_[*bundle_[lanes[0].terms[i].value.value]].lanes;
    const auto root = [&](std::size_t l) { return of[l].root; };
    for (std::size_t from = 0; from + lanes.size() <= of.size(); from += lanes.size()) {
      std::size_t l = 0;
      while (l < lanes.size() && lanes[l].terms[i].value == root(from + l)) ++l;
      if (l == lanes.size()) return true;
    }
    return false;
  }

  const Program& program_;
  const Groups& groups_;
  const std::vector<LikeGroups>& bundles_;
  std::vector<bool> kept_;
  std::vector<std::optional<std::size_t>> bundle_;
};

class Building {
 public:
  Building(const Program& program, const Groups& groups, std::vector<LikeGroups> bundles)
      : program_(program),
        groups_(groups),
        order_(order_in_lanes(program, groups, std::move(bundles))),
        placed_(program.nodes.size()) {}

  Program run() {
    result_.name = program_.name;
    for (const std::size_t unit : order_.units)
      if (unit < program_.nodes.size())
        compute(ValueId(unit));
      else
        compute(order_.bundles[unit - program_.nodes.size()]);
    for (const ir::Output& output : program_.outputs)
      result_.outputs.push_back(
          {output.name, output.row, output.column, exactly(place(output.value), false)});
    return std::move(result_);
  }

 private:
  // Values

  ValueId append(const Node& node, const std::string& label = "") {
    result_.nodes.push_back(node);
    result_.labels.push_back(label);
    return ValueId(result_.nodes.size() - 1);
  }

  ValueId operation(Op op, ValueId a, ValueId b, const std::string& label) {
    Node node;
    node.op = op;
    node.a = a;
    node.b = b;
    return append(node, label);
  }

  ValueId negation(ValueId value) {
    const auto [it, is_new] = negations_.try_emplace(value);
    if (is_new) it->second = operation(Op::kNegate, value, {}, "");
    return it->second;
  }

  ValueId literal(Node node, bool negative) {
    if (negative) {
      node.literal = -node.literal;
      for (double& part : node.tail) part = -part;
    }
    const std::array<double, 4> key = {node.literal, node.tail[0], node.tail[1], node.tail[2]};
    const auto [it, is_new] = literals_.try_emplace(key);
    if (is_new) it->second = append(node);
    return it->second;
  }

  /// Where a value of the program is now, or its negative.
  Signed place(ValueId value) {
    if (!placed_[value.value]) {
      const Node& node = program_[value];
      JD_CHECK(ir::operand_count(node.op) == 0, "%{} of '{}' is not there yet", value.value, program_.name);
      placed_[value.value] = Signed{node.op == Op::kLiteral ? literal(node, false) : append(node)};
    }
    return *placed_[value.value];
  }

  ValueId exactly(Signed value, bool negative) {
    return value.negative == negative ? value.value : negation(value.value);
  }

  ValueId exactly(ValueId value, bool negative) {
    if (program_[value].op == Op::kLiteral) return literal(program_[value], negative);
    return exactly(place(value), negative);
  }

  void compute(ValueId value) {
    const Node& node = program_[value];
    const std::string& label = program_.labels[value.value];
    const Signed a = place(node.a), b = ir::operand_count(node.op) == 2 ? place(node.b) : Signed();
    placed_[value.value] = computed(node.op, a, b, label);
  }

  Signed computed(Op op, Signed a, Signed b, const std::string& label) {
    switch (op) {
      case Op::kNegate:
        return a.negative ? Signed{a.value} : Signed{operation(op, a.value, {}, label)};
      case Op::kSubtract:
        return computed(Op::kAdd, a, -b, label);
      case Op::kAdd:
        if (a.negative == b.negative) return {operation(Op::kAdd, a.value, b.value, label), a.negative};
        if (a.negative) std::swap(a, b);
        return {operation(Op::kSubtract, a.value, b.value, label)};
      case Op::kMultiply:
      case Op::kDivide:
        return {operation(op, a.value, b.value, label), a.negative != b.negative};
      default:
        return {operation(op, exactly(a, false), ir::operand_count(op) == 2 ? exactly(b, false) : ValueId(),
                          label)};
    }
  }

  // Bundles

  void compute(const LikeGroups& bundle) {
    std::vector<std::vector<ValueId>> terms;  // by lane
    for (const LikeGroups::Lane& lane : bundle.lanes) terms.push_back(terms_of(bundle, lane));
    std::size_t next = 0;
    const std::vector<ValueId> roots = compute(bundle, bundle.lanes[0].root, terms, next);
    for (std::size_t l = 0; l < roots.size(); ++l)
      placed_[bundle.lanes[l].root.value] = Signed{roots[l], bundle.lanes[l].negative};
  }

  /// With the signs that make what lane 0 does with them the value of the lane, or its negative.
  std::vector<ValueId> terms_of(const LikeGroups& bundle, const LikeGroups::Lane& lane) {
    const std::vector<Term>& first = bundle.lanes[0].terms;
    const bool is_sum = groups_.at(bundle.lanes[0].root)->op == Op::kAdd;
    std::vector<bool> negative;
    for (std::size_t i = 0; i < lane.terms.size(); ++i)
      negative.push_back(is_sum ? (first[i].negative != lane.terms[i].negative) != lane.negative
                                : is_stored_negative(lane.terms[i].value));
    if (!is_sum) {
      bool product = false;
      for (const bool factor : negative) product = product != factor;
      if (product != lane.negative) {
        const std::size_t free = free_factor(lane);
        negative[free] = !negative[free];
      }
    }
    std::vector<ValueId> values;
    for (std::size_t i = 0; i < lane.terms.size(); ++i)
      values.push_back(exactly(lane.terms[i].value, negative[i]));
    return values;
  }

  bool is_stored_negative(ValueId value) {
    return program_[value].op != Op::kLiteral && place(value).negative;
  }

  /// A literal, or else one that is computed alone, which takes the other sign.
  std::size_t free_factor(const LikeGroups::Lane& lane) const {
    for (std::size_t i = 0; i < lane.terms.size(); ++i)
      if (program_[lane.terms[i].value].op == Op::kLiteral) return i;
    for (std::size_t i = 0; i < lane.terms.size(); ++i)
      if (const auto& unit = order_.unit[lane.terms[i].value.value]; !unit || *unit < program_.nodes.size())
        return i;
    return 0;
  }

  /// The operations of lane 0's group, each for all lanes.
  std::vector<ValueId> compute(const LikeGroups& bundle, ValueId value,
                               const std::vector<std::vector<ValueId>>& terms, std::size_t& next) {
    const Node& node = program_[value];
    const auto operand = [&](ValueId id) {
      if (groups_.is_within(id)) return compute(bundle, id, terms, next);
      std::vector<ValueId> list;
      for (const std::vector<ValueId>& lane : terms) list.push_back(lane[next]);
      ++next;
      return list;
    };
    const std::vector<ValueId> a = operand(node.a), b = operand(node.b);
    std::vector<ValueId> results;
    for (std::size_t l = 0; l < bundle.lanes.size(); ++l) {
      const bool is_root = value == bundle.lanes[0].root;
      results.push_back(
          operation(node.op, a[l], b[l], is_root ? program_.labels[bundle.lanes[l].root.value] : ""));
    }
    result_.lanes.push_back(results);
    return results;
  }

  const Program& program_;
  const Groups& groups_;
  LaneOrder order_;
  std::vector<std::optional<Signed>> placed_;
  std::map<ValueId, ValueId> negations_;
  std::map<std::array<double, 4>, ValueId> literals_;
  Program result_;
};

}  // namespace

std::size_t saved_by_lanes(const Program& program) {
  std::size_t operations = 0;
  for (const std::vector<ValueId>& bundle : program.lanes) operations += bundle.size() - 1;
  return operations;
}

Program in_lanes(const Program& program, const std::vector<LikeLimbs>& limbs, const LeastGain& least) {
  const Reordered by_limb = limb_by_limb(program, limbs);
  const Groups groups(by_limb.program, by_limb.apart);
  std::vector<LikeGroups> bundles =
      Gain(by_limb.program, groups, like_values(by_limb.program, groups, limbs).groups).worthwhile();
  if (bundles.empty()) return program;
  Program result = Building(by_limb.program, groups, std::move(bundles)).run();
  const std::size_t saved = saved_by_lanes(result);
  const bool pays =
      saved >= least.operations && saved * 100 >= ir::count_operations(program).arithmetic() * least.percent;
  return pays ? result : program;
}

}  // namespace jourdain::passes
