#include "passes/like_values.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "passes/parity.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::ValueId;

namespace {

constexpr std::size_t kMostCompared = 64;  ///< values on the way from what limbs share to one of their values
constexpr std::size_t kMostLanes = 4;

/// Values that angles are made of.
std::vector<bool> made_into_angles(const Program& program) {
  std::vector<bool> marked(program.nodes.size());
  for (std::size_t i = program.nodes.size(); i-- > 0;) {
    const Node& node = program.nodes[i];
    if (node.op != Op::kSin && node.op != Op::kCos && !marked[i]) continue;
    if (ir::operand_count(node.op) >= 1) marked[node.a.value] = true;
    if (ir::operand_count(node.op) == 2) marked[node.b.value] = true;
  }
  return marked;
}

/// Without the numbers in it: limbs count their links differently.
std::string shape_of(const std::string& label) {
  std::string shape;
  for (const char c : label)
    if (c < '0' || c > '9') shape += c;
  return shape;
}

class Search {
 public:
  Search(const Program& program, const Groups& groups)
      : program_(program),
        groups_(groups),
        angles_(made_into_angles(program)),
        bundle_(program.nodes.size()) {
    for (std::size_t i = 0; i < program.nodes.size(); ++i)
      if (program.nodes[i].op == Op::kLeaf)
        leaves_[{program.nodes[i].leaf, program.nodes[i].index}] = ValueId(i);
  }

  /// Four at once where there are four, then two at once what is not alike in all four.
  void run(const LikeLimbs& limbs, std::size_t kind) {
    for (std::size_t first = 0; first < limbs.size();) {
      const std::size_t count = std::min<std::size_t>(limbs.size() - first, kMostLanes);
      const auto lanes = [&](std::size_t from, std::size_t size) {
        std::vector<std::size_t> list;
        for (std::size_t i = 0; i < size; ++i) list.push_back(from + i);
        run(limbs, list, kind);
      };
      if (count == kMostLanes) lanes(first, kMostLanes);
      for (std::size_t pair = first; pair + 1 < first + count; pair += 2) lanes(pair, 2);
      first += count;
    }
  }

  LikeValues finish() {
    std::vector<SumOverLimbs> sums;
    for (std::size_t i = 0; i < program_.nodes.size(); ++i)
      if (SumOverLimbs sum = sum_over_limbs(ValueId(i)); !sum.together.empty())
        sums.push_back(std::move(sum));
    const std::vector<bool> negative = signs_.solution(found_.size() * kMostLanes);
    for (std::size_t p = 0; p < found_.size(); ++p)
      for (std::size_t l = 0; l < found_[p].lanes.size(); ++l)
        found_[p].lanes[l].negative = negative[unknown(p, l)];
    return {std::move(found_), std::move(sums)};
  }

 private:
  /// The group of lane 0, and the same in the other lanes.
  using Tuple = std::vector<ValueId>;

  static std::size_t unknown(std::size_t bundle, std::size_t lane) { return bundle * kMostLanes + lane; }

  void run(const LikeLimbs& limbs, const std::vector<std::size_t>& lanes, std::size_t kind) {
    lanes_ = lanes.size();
    image_.assign(lanes_, std::vector<std::optional<ValueId>>(program_.nodes.size()));
    is_image_.assign(lanes_, std::vector<bool>(program_.nodes.size()));
    for (std::size_t i = 0; i < limbs[lanes[0]].size(); ++i) {
      Tuple tuple;
      for (const std::size_t lane : lanes) {
        const auto it = leaves_.find({limbs[lane][i].kind, limbs[lane][i].index});
        if (it != leaves_.end()) tuple.push_back(it->second);
      }
      if (tuple.size() == lanes_) map(tuple);
    }
    for (std::size_t p = 0; p < found_.size(); ++p) {
      if (origin_[p].first != kind) continue;
      Tuple tuple;
      for (const std::size_t lane : lanes)
        for (std::size_t l = 0; l < origin_[p].second.size(); ++l)
          if (origin_[p].second[l] == lane) tuple.push_back(found_[p].lanes[l].root);
      if (tuple.size() == lanes_) map(tuple);
    }
    current_ = {kind, lanes};
    for (std::size_t i = 0; i < program_.nodes.size(); ++i) visit(ValueId(i));
  }

  void visit(ValueId value) {
    const Group* group = groups_.at(value);
    if (!group || image_[1][value.value] || bundle_[value.value]) return;
    std::optional<Tuple> tuple = same_in_other_lanes(value, *group);
    if (!tuple) return;
    if (is_alone(value))
      map(*tuple);
    else
      bundle(*tuple);
  }

  /// Computed one by one: what has no operation on several numbers, and angles.
  bool is_alone(ValueId value) const {
    const Op op = program_[value].op;
    return angles_[value.value] || op == Op::kSin || op == Op::kCos || op == Op::kSqrt ||
           ir::is_function(op) || op == Op::kNegate;
  }

  void map(const Tuple& tuple) {
    for (std::size_t l = 1; l < lanes_; ++l) {
      image_[l][tuple[0].value] = tuple[l];
      is_image_[l][tuple[l].value] = true;
    }
  }

  bool is_literal(ValueId value) const { return program_[value].op == Op::kLiteral; }

  /// Groups of the shape of `value` whose terms are the images of its terms. None unless there is one in each lane, all
  /// different.
  std::optional<Tuple> same_in_other_lanes(ValueId value, const Group& group) const {
    const auto known = std::find_if(group.terms.begin(), group.terms.end(), [&](const Term& term) {
      return image_[1][term.value.value].has_value();
    });
    if (known == group.terms.end()) return {};
    Tuple tuple = {value};
    for (std::size_t l = 1; l < lanes_; ++l) {
      if (!image_[l][known->value.value]) return {};
      std::optional<std::pair<long, ValueId>> best;
      for (const ValueId other : groups_.users(*image_[l][known->value.value])) {
        if (std::find(tuple.begin(), tuple.end(), other) != tuple.end() || bundle_[other.value] ||
            is_image_[l][other.value] || is_alone(other) != is_alone(value))
          continue;
        const std::optional<std::vector<Term>> terms = aligned(value, other, l);
        if (!terms) continue;
        const long score = likeness(value, other, group.terms, *terms);
        if (!best || score > best->first) best = {score, other};
      }
      if (!best) return {};
      tuple.push_back(best->second);
    }
    return tuple;
  }

  long likeness(ValueId value, ValueId other, const std::vector<Term>& terms,
                const std::vector<Term>& others) const {
    long score = shape_of(program_.labels[value.value]) == shape_of(program_.labels[other.value]) ? 1 : 0;
    for (std::size_t i = 0; i < terms.size(); ++i)
      if (!image_[1][terms[i].value.value] && !is_literal(terms[i].value) &&
          terms[i].value != others[i].value)
        score -= 2;
    return score;
  }

  /// The terms of `other` in the order of those of `value`: images where there are, then what both share, literals,
  /// and last what is left. None where they have different shapes.
  std::optional<std::vector<Term>> aligned(ValueId value, ValueId other, std::size_t lane) const {
    const Group &group = *groups_.at(value), &like = *groups_.at(other);
    if (group.op != like.op || group.terms.size() != like.terms.size()) return {};
    std::vector<Term> result(group.terms.size());
    std::vector<bool> done(group.terms.size()), used(group.terms.size());
    const bool is_ordered = group.op == Op::kDivide || ir::is_function(group.op);
    const auto assign = [&](std::size_t i, const auto& fits) -> bool {
      for (std::size_t j = 0; j < like.terms.size(); ++j)
        if (!used[j] && (!is_ordered || i == j) && fits(like.terms[j].value)) {
          result[i] = like.terms[j];
          return done[i] = used[j] = true;
        }
      return false;
    };
    for (std::size_t i = 0; i < group.terms.size(); ++i)
      if (const std::optional<ValueId> image = image_[lane][group.terms[i].value.value])
        if (!assign(i, [&](ValueId term) { return term == *image; })) return {};
    for (std::size_t i = 0; i < group.terms.size(); ++i)
      if (!done[i]) assign(i, [&](ValueId term) { return term == group.terms[i].value; });
    for (std::size_t i = 0; i < group.terms.size(); ++i)
      if (!done[i] && is_literal(group.terms[i].value) &&
          !assign(i, [&](ValueId term) { return is_literal(term); }))
        return {};
    for (std::size_t i = 0; i < group.terms.size(); ++i)
      if (!done[i] &&
          !assign(i, [&](ValueId term) { return !is_literal(term) && !is_image_[lane][term.value]; }))
        return {};
    return result;
  }

  /// Computes the tuple at once, unless signs do not allow that.
  bool bundle(const Tuple& tuple) {
    LikeGroups groups;
    groups.lanes.push_back({tuple[0], groups_.at(tuple[0])->terms});
    for (std::size_t l = 1; l < lanes_; ++l)
      groups.lanes.push_back({tuple[l], *aligned(tuple[0], tuple[l], l)});
    bundle_what_is_left(groups);
    const std::size_t before = signs_.size(), index = found_.size();
    for (std::size_t l = 0; l < lanes_; ++l)
      if (!add_signs(groups, index, l)) {
        signs_.forget(before);
        return false;
      }
    for (const ValueId value : tuple) bundle_[value.value] = index;
    found_.push_back(std::move(groups));
    origin_.push_back(current_);
    map(tuple);
    return true;
  }

  /// Terms that are no images but of one shape in all lanes.
  void bundle_what_is_left(const LikeGroups& groups) {
    for (std::size_t i = 0; i < groups.lanes[0].terms.size(); ++i) {
      Tuple tuple;
      for (const LikeGroups::Lane& lane : groups.lanes) tuple.push_back(lane.terms[i].value);
      std::size_t compared = 0;
      if (is_like(tuple, compared)) bundle(tuple);
    }
  }

  /// Of values that are neither bundled nor shared: have they one shape, down to what is shared?
  bool is_like(const Tuple& tuple, std::size_t& compared) const {
    if (++compared > kMostCompared) return false;
    for (std::size_t l = 0; l < lanes_; ++l) {
      const ValueId value = tuple[l];
      if (!groups_.at(value) || bundle_[value.value] || is_alone(value) || image_[1][value.value])
        return false;
      if (l > 0 && is_image_[l][value.value]) return false;
      if (std::find(tuple.begin() + static_cast<long>(l) + 1, tuple.end(), value) != tuple.end())
        return false;
    }
    const std::vector<Term>& terms = groups_.at(tuple[0])->terms;
    std::vector<std::vector<Term>> others;
    for (std::size_t l = 1; l < lanes_; ++l) {
      std::optional<std::vector<Term>> other = aligned(tuple[0], tuple[l], l);
      if (!other) return false;
      others.push_back(std::move(*other));
    }
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (is_literal(terms[i].value) || image_[1][terms[i].value.value]) continue;
      Tuple inner = {terms[i].value};
      for (const std::vector<Term>& other : others) inner.push_back(other[i].value);
      const bool is_shared =
          std::all_of(inner.begin(), inner.end(), [&](ValueId value) { return value == inner[0]; });
      if (!is_shared && !is_like(inner, compared)) return false;
    }
    return true;
  }

  /// What a lane adds up has the signs of lane 0: its terms have them too, or the opposite.
  bool add_signs(const LikeGroups& groups, std::size_t index, std::size_t lane) {
    const LikeGroups::Lane &first = groups.lanes[0], &own = groups.lanes[lane];
    const bool is_sum = groups_.at(first.root)->op == Op::kAdd;
    if (lane == 0 && !signs_.add({unknown(index, 0)}, false)) return false;
    std::vector<std::size_t> factors = {unknown(index, lane)};
    bool is_free = false;  // a factor that is computed alone takes any sign
    for (std::size_t i = 0; i < own.terms.size(); ++i) {
      const std::optional<std::size_t> sign = sign_of(groups, i, lane);
      if (!sign)
        is_free = true;
      else if (is_sum &&
               !signs_.add({unknown(index, lane), *sign}, first.terms[i].negative != own.terms[i].negative))
        return false;
      else
        factors.push_back(*sign);
    }
    return is_sum || is_free || signs_.add(factors, false);
  }

  /// Of term `i`, where all lanes of it are those of groups that are computed at once.
  std::optional<std::size_t> sign_of(const LikeGroups& groups, std::size_t i, std::size_t lane) const {
    const std::optional<std::size_t> bundle = bundle_[groups.lanes[lane].terms[i].value.value];
    const bool is_one = std::all_of(
        groups.lanes.begin(), groups.lanes.end(),
        [&](const LikeGroups::Lane& other) { return bundle_[other.terms[i].value.value] == bundle; });
    if (!bundle || !is_one) return {};
    const std::vector<LikeGroups::Lane>& lanes = found_[*bundle].lanes;
    for (std::size_t l = 0; l < lanes.size(); ++l)
      if (lanes[l].root == groups.lanes[lane].terms[i].value) return unknown(*bundle, l);
    return {};
  }

  /// Decides signs that are free so that as many groups as possible go together.
  SumOverLimbs sum_over_limbs(ValueId root) {
    SumOverLimbs sum{root, {}};
    const Group* group = groups_.at(root);
    if (!group || group->op != Op::kAdd || bundle_[root.value]) return sum;
    std::map<std::size_t, std::map<ValueId, bool>> terms;  // by bundle: is it subtracted?
    std::set<std::size_t> twice;                           // read so: left alone
    for (const Term& term : group->terms)
      if (const auto& bundle = bundle_[term.value.value])
        if (!terms[*bundle].emplace(term.value, term.negative).second) twice.insert(*bundle);
    for (const std::size_t bundle : twice) terms.erase(bundle);
    const auto differs = [&](std::size_t bundle, std::size_t lane) {
      const auto sign = [&](std::size_t l) { return terms.at(bundle).at(found_[bundle].lanes[l].root); };
      return sign(lane) != sign(0);
    };
    const auto go_together = [&](std::size_t p, std::size_t q) {
      if (origin_[p] != origin_[q]) return false;
      const std::size_t before = signs_.size();
      for (std::size_t l = 1; l < found_[p].lanes.size(); ++l)
        if (!signs_.add({unknown(p, l), unknown(q, l)}, differs(p, l) != differs(q, l))) {
          signs_.forget(before);
          return false;
        }
      return true;
    };
    for (const auto& [bundle, signs] : terms) {
      if (signs.size() != found_[bundle].lanes.size()) continue;
      const auto place = std::find_if(sum.together.begin(), sum.together.end(),
                                      [&, p = bundle](const auto& list) { return go_together(list[0], p); });
      if (place != sum.together.end())
        place->push_back(bundle);
      else
        sum.together.push_back({bundle});
    }
    sum.together.erase(std::remove_if(sum.together.begin(), sum.together.end(),
                                      [](const auto& list) { return list.size() < 2; }),
                       sum.together.end());
    return sum;
  }

  const Program& program_;
  const Groups& groups_;
  std::map<std::pair<ir::LeafKind, std::size_t>, ValueId> leaves_;
  std::vector<bool> angles_;
  std::vector<LikeGroups> found_;
  std::vector<std::pair<std::size_t, std::vector<std::size_t>>> origin_;  ///< of what is found: its limbs
  std::pair<std::size_t, std::vector<std::size_t>> current_;
  std::vector<std::optional<std::size_t>> bundle_;  ///< of a value: where it was found
  std::size_t lanes_ = 0;
  std::vector<std::vector<std::optional<ValueId>>> image_;  ///< by lane and value of lane 0
  std::vector<std::vector<bool>> is_image_;
  Parity signs_;
};

}  // namespace

LikeValues like_values(const Program& program, const Groups& groups, const std::vector<LikeLimbs>& limbs) {
  Search search(program, groups);
  for (std::size_t kind = 0; kind < limbs.size(); ++kind) search.run(limbs[kind], kind);
  return search.finish();
}

}  // namespace jourdain::passes
