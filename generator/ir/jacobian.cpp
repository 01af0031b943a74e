#include "ir/jacobian.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "ir/function_partials.hpp"

namespace jourdain::ir {

namespace {

class Graph {
 public:
  Graph(Builder& builder, const std::vector<Signed>& values, const std::vector<Seed>& seeds,
        const std::vector<Signed>& held)
      : builder_(builder),
        count_(builder.program().nodes.size()),
        rows_(values.size()),
        is_held_(count_, false) {
    for (const Signed& value : held) is_held_[value.value.value] = true;
    std::size_t columns = 0;
    for (const Seed& seed : seeds) columns = std::max(columns, seed.column + 1);
    operands_.resize(count_ + columns + rows_);
    users_.resize(operands_.size());
    columns_ = columns;
    const std::vector<bool> needed = needed_by(values);
    for (const Seed& seed : seeds)
      if (needed[seed.leaf.value.value])
        connect(column(seed.column), seed.leaf.value.value,
                seed.leaf.negative ? -seed.partial : seed.partial);
    for (std::size_t i = 0; i < count_; ++i)
      if (needed[i] && !is_held_[i]) add_partials(i);
    for (std::size_t r = 0; r < rows_; ++r)
      if (is_active(values[r].value.value)) {
        const Signed one = builder_.literal(1);
        connect(values[r].value.value, row(r), values[r].negative ? -one : one);
      }
  }

  JacobianEntries eliminate(const Surroundings& surroundings) {
    for (const std::uint32_t v : elimination_order(builder_.program(), count_, operands_, surroundings))
      remove(v);
    JacobianEntries entries;
    for (std::size_t r = 0; r < rows_; ++r)
      for (const auto& [operand, partial] : operands_[row(r)])
        if (!builder_.is_literal(partial, 0)) entries[{r, operand - count_}] = partial;
    return entries;
  }

 private:
  std::size_t column(std::size_t k) const { return count_ + k; }
  std::size_t row(std::size_t k) const { return count_ + columns_ + k; }
  bool is_active(std::size_t v) const { return !operands_[v].empty(); }

  std::vector<bool> needed_by(const std::vector<Signed>& values) const {
    std::vector<bool> needed(count_, false);
    for (const Signed& value : values) needed[value.value.value] = true;
    for (std::size_t i = count_; i-- > 0;) {
      if (!needed[i] || is_held_[i]) continue;
      const Node& node = builder_.program().nodes[i];
      if (operand_count(node.op) >= 1) needed[node.a.value] = true;
      if (operand_count(node.op) == 2) needed[node.b.value] = true;
    }
    return needed;
  }

  void add_partials(std::size_t i) {
    const Node node = builder_.program().nodes[i];
    const Signed value{ValueId(i)}, a{node.a}, b{node.b}, one = builder_.literal(1);
    const bool by_a = operand_count(node.op) >= 1 && is_active(node.a.value);
    const bool by_b = operand_count(node.op) == 2 && is_active(node.b.value);
    const auto from_a = [&](Signed partial) { connect(node.a.value, i, partial); };
    switch (node.op) {
      case Op::kLiteral:
      case Op::kLeaf:
        break;
      case Op::kNegate:
        if (by_a) from_a(-one);
        break;
      case Op::kAdd:
      case Op::kSubtract:
        if (by_a) from_a(one);
        if (by_b) connect(node.b.value, i, node.op == Op::kAdd ? one : -one);
        break;
      case Op::kMultiply:
        if (by_a) from_a(b);
        if (by_b) connect(node.b.value, i, a);
        break;
      case Op::kDivide: {
        if (!by_a && !by_b) break;
        const Signed inverse = builder_.divide(one, b);
        if (by_a) from_a(inverse);
        if (by_b) connect(node.b.value, i, -builder_.multiply(value, inverse));
        break;
      }
      case Op::kSqrt:
        if (by_a) from_a(builder_.divide(builder_.literal(0.5), value));
        break;
      case Op::kSin:
        if (by_a) from_a(builder_.unary(Op::kCos, a));
        break;
      case Op::kCos:
        if (by_a) from_a(-builder_.unary(Op::kSin, a));
        break;
      case Op::kArgument:  // what calls with it has its derivatives
        break;
      case Op::kCall:
        add_slopes(i);
        break;
      default: {
        if (!by_a && !by_b) break;
        const auto [of_a, of_b] = partials(builder_, function_of(node.op), a, b, value, by_b);
        if (by_a) from_a(of_a);
        if (by_b) connect(node.b.value, i, of_b);
        break;
      }
    }
  }

  /// Of a call, by its arguments: calls of its partial derivatives with the same.
  void add_slopes(std::size_t i) {
    const Node call = builder_.program().nodes[i];
    const auto number = static_cast<std::uint32_t>(builder_.program()[call.b].literal);
    std::size_t k = support::called_function(number).arguments.size();
    for (Node list{.op = Op::kArgument, .b = call.a}; k-- > 0;) {
      list = builder_.program()[list.b];
      if (!is_active(list.a.value)) continue;
      const Signed slope = builder_.literal(support::number_of_slope(number, k));
      connect(list.a.value, i, builder_.function(support::Function::kCall, Signed{call.a}, slope));
    }
  }

  void connect(std::size_t from, std::size_t to, Signed partial) {
    const auto [it, is_new] = operands_[to].try_emplace(from, partial);
    if (!is_new) it->second = builder_.add(it->second, partial);
    users_[from].insert(to);
  }

  void remove(std::size_t v) {
    for (const std::size_t user : users_[v]) {
      const Signed outer = operands_[user].at(v);
      operands_[user].erase(v);
      for (const auto& [operand, inner] : operands_[v]) {
        const Signed partial = product(outer, inner);
        if (!builder_.is_literal(partial, 0)) connect(operand, user, partial);
      }
    }
    for (const auto& [operand, inner] : operands_[v]) users_[operand].erase(v);
    operands_[v].clear();
    users_[v].clear();
  }

  /// Signs that all have to hold, of values by their number, and the selection that asks for them. First those of
  /// values that always exist, which may decide whether the others do.
  using Guard = std::vector<std::pair<std::size_t, Op>>;
  /// A sum of values each of which is taken where its guard holds.
  using Parts = std::map<Guard, Signed>;
  static constexpr std::size_t kMostParts = 4;

  /// Zero times what has no value would have none: where a factor is only taken where a sign says so, and the other
  /// need not exist, the other is taken there alone as well.
  Signed product(Signed a, Signed b) {
    look_at_new_values();
    const bool exists_a = exists_[a.value.value], exists_b = exists_[b.value.value];
    if (is_taken_[a.value.value] && !exists_b) return inside(a, b);
    if (is_taken_[b.value.value] && !exists_a) return inside(b, a);
    return builder_.multiply(a, b);
  }

  /// `value` times `factor`, which goes where no more signs decide.
  Signed inside(Signed value, Signed factor) {
    const Parts& known = parts(value.value);
    if (known.empty()) {
      const Signed half = builder_.literal(0.5),
                   some = builder_.subtract(some_part_is_taken(value.value), half);
      const Signed needed = builder_.function(support::Function::kWhereNotNegative, some, factor);
      return builder_.multiply(value, needed);
    }
    Parts all = known;
    for (auto& [guard, part] : all) part = product(part, factor);
    const Signed sum = taken(all.begin(), all.end(), 0);
    return value.negative ? -sum : sum;
  }

  /// The sum of parts whose guards have the first `depth` signs in common, which hold.
  Signed taken(Parts::const_iterator begin, Parts::const_iterator end, std::size_t depth) {
    Signed sum = builder_.literal(0);
    while (begin != end) {
      if (begin->first.size() == depth) {
        sum = builder_.add(sum, (begin++)->second);
        continue;
      }
      const auto [sign, selection] = begin->first[depth];
      const auto alike = std::find_if(begin, end, [&, s = sign, o = selection](const auto& part) {
        return part.first[depth] != std::pair(s, o);
      });
      const Signed inner = taken(begin, alike, depth + 1);
      sum = builder_.add(sum, builder_.function(function_of(selection), Signed{ValueId(sign)}, inner));
      begin = alike;
    }
    return sum;
  }

  /// A value as a sum of what is taken by signs: factors of selections stand inside them, and what one guard takes is
  /// one part. None where they would be more than kMostParts: signs in a chain may have as many ways as there are
  /// combinations.
  const Parts& parts(ValueId value) {
    if (const auto known = parts_.find(value.value); known != parts_.end()) return known->second;
    Parts result;
    if (!is_taken_.at(value.value)) {
      result[{}] = {value};
    } else {
      const Node node = builder_.program()[value];
      const bool by_a = is_taken_[node.a.value];
      bool is_whole = true;
      const auto take = [&](ValueId from, const auto& with) {
        const Parts& all = parts(from);
        is_whole = is_whole && !all.empty();
        for (const auto& [guard, part] : all) with(guard, part);
      };
      switch (node.op) {
        case Op::kNegate:
          take(node.a, [&](const Guard& guard, Signed part) { add(result, guard, -part); });
          break;
        case Op::kAdd:
        case Op::kSubtract:
          take(node.a, [&](const Guard& guard, Signed part) { add(result, guard, part); });
          take(node.b, [&](const Guard& guard, Signed part) {
            add(result, guard, node.op == Op::kAdd ? part : -part);
          });
          break;
        case Op::kMultiply:
          take(by_a ? node.a : node.b, [&](const Guard& guard, Signed part) {
            add(result, guard, builder_.multiply(part, {by_a ? node.b : node.a}));
          });
          break;
        default:
          take(node.b, [&](const Guard& guard, Signed part) {
            if (const auto both = conjunction({{node.a.value, node.op}}, guard)) add(result, *both, part);
          });
          // Where nothing is ever taken, zero is.
          if (is_whole && result.empty()) result[{}] = builder_.literal(0);
      }
      if (!is_whole || result.size() > kMostParts) result.clear();
    }
    look_at_new_values();
    return parts_.emplace(value.value, std::move(result)).first->second;
  }

  /// 1 where some part of a value is taken, 0 where none is.
  Signed some_part_is_taken(ValueId value) {
    if (const auto known = some_.find(value.value); known != some_.end()) return known->second;
    Signed result = builder_.literal(1);
    if (is_taken_.at(value.value)) {
      const Node node = builder_.program()[value];
      const auto of = [this](ValueId v) { return some_part_is_taken(v); };
      if (node.op == Op::kAdd || node.op == Op::kSubtract) {
        const Signed of_b = of(node.b);
        result = builder_.function(support::Function::kMax, of(node.a), of_b);
      } else if (node.op == Op::kMultiply || node.op == Op::kNegate) {
        result = of(is_taken_[node.a.value] ? node.a : node.b);
      } else {
        result = builder_.function(function_of(node.op), Signed{node.a}, of(node.b));
      }
    }
    look_at_new_values();
    return some_.emplace(value.value, result).first->second;
  }

  void add(Parts& parts, const Guard& guard, Signed part) {
    const auto [it, is_new] = parts.try_emplace(guard, part);
    if (!is_new) it->second = builder_.add(it->second, part);
  }

  /// Nothing where signs contradict each other.
  std::optional<Guard> conjunction(const Guard& a, const Guard& b) const {
    const auto key = [this](const auto& sign) {
      return std::tuple(!exists_.at(sign.first), sign.first, sign.second);
    };
    Guard both;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both),
                   [&](const auto& x, const auto& y) { return key(x) < key(y); });
    const auto contradicts = [](const auto& x, const auto& y) { return x.first == y.first; };
    if (std::adjacent_find(both.begin(), both.end(), contradicts) != both.end()) return {};
    return both;
  }

  /// Which values are finite for all finite variables (parameters are taken to be such that what follows from them
  /// alone is), and which consist of what is taken where a sign says so.
  void look_at_new_values() {
    const std::vector<Node>& nodes = builder_.program().nodes;
    for (std::size_t i = exists_.size(); i < nodes.size(); ++i) {
      const Node& node = nodes[i];
      const int operands = operand_count(node.op);
      const auto holds = [&](const std::vector<bool>& of, bool otherwise) {
        if (operands == 0) return otherwise;
        return of[node.a.value] && (operands == 1 || of[node.b.value]);
      };
      fixed_.push_back(holds(fixed_, node.op == Op::kLiteral || is_made_with_the_model(node.leaf)));
      bounds_.push_back(bound(node));
      const bool may_fail =
          (node.op == Op::kDivide && !fixed_[node.b.value] && bounds_[node.b.value] != Bound::kPositive) ||
          (node.op == Op::kSqrt && bounds_[node.a.value] == Bound::kNone) ||
          (is_function(node.op) && !is_selection(node.op) && node.op != Op::kTanh);
      exists_.push_back(fixed_[i] || (holds(exists_, true) && !may_fail));
      const bool is_sum_or_product = node.op == Op::kAdd || node.op == Op::kSubtract ||
                                     node.op == Op::kMultiply || node.op == Op::kNegate;
      is_taken_.push_back(
          node.op == Op::kWhereNegative || node.op == Op::kWhereNotNegative ||
          (is_sum_or_product && (is_taken_[node.a.value] || (operands == 2 && is_taken_[node.b.value]))));
    }
  }

  /// What a value is never below, for all variables and parameters.
  enum class Bound { kNone, kZero, kPositive };  ///< kPositive: a positive constant

  Bound bound(const Node& node) const {
    const auto of = [this](ValueId v) { return bounds_[v.value]; };
    switch (node.op) {
      case Op::kLiteral:
        return node.literal > 0 ? Bound::kPositive : node.literal == 0 ? Bound::kZero : Bound::kNone;
      case Op::kAdd: {
        const Bound less = std::min(of(node.a), of(node.b));
        return less == Bound::kNone ? less : std::max(of(node.a), of(node.b));
      }
      case Op::kMultiply:
        return node.a == node.b && of(node.a) == Bound::kNone ? Bound::kZero
                                                              : std::min(of(node.a), of(node.b));
      case Op::kSqrt:
        return of(node.a);
      default:
        return Bound::kNone;
    }
  }

  Builder& builder_;
  std::vector<Bound> bounds_;
  std::vector<bool> exists_, fixed_, is_taken_;  ///< of the values so far
  std::map<std::size_t, Parts> parts_;
  std::map<std::size_t, Signed> some_;
  std::size_t count_, columns_ = 0, rows_;
  std::vector<bool> is_held_;
  std::vector<Partials> operands_;  // of each vertex
  std::vector<std::set<std::size_t>> users_;
};

}  // namespace

JacobianEntries differentiate(Builder& builder, const std::vector<Signed>& values,
                              const std::vector<Seed>& seeds, const std::vector<Signed>& held,
                              const Surroundings& surroundings) {
  return Graph(builder, values, seeds, held).eliminate(surroundings);
}

}  // namespace jourdain::ir
