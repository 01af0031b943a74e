#include "ir/jacobian.hpp"

#include <algorithm>
#include <set>

#include "ir/function_partials.hpp"

namespace jourdain::ir {

namespace {

class Graph {
 public:
  Graph(Builder& builder, const std::vector<Signed>& values, const std::vector<Seed>& seeds)
      : builder_(builder), count_(builder.program().nodes.size()), rows_(values.size()) {
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
      if (needed[i]) add_partials(i);
    for (std::size_t r = 0; r < rows_; ++r)
      if (is_active(values[r].value.value)) {
        const Signed one = builder_.literal(1);
        connect(values[r].value.value, row(r), values[r].negative ? -one : one);
      }
  }

  JacobianEntries eliminate(EliminationOrder order) {
    const auto forward = static_cast<std::size_t>(order.forward * static_cast<double>(count_));
    for (std::size_t k = 0; k < forward; ++k) remove(k);
    for (std::size_t k = count_; k-- > forward;) remove(k);
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
      if (!needed[i]) continue;
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
      default: {
        if (!by_a && !by_b) break;
        const auto [of_a, of_b] = partials(builder_, function_of(node.op), a, b, value, by_b);
        if (by_a) from_a(of_a);
        if (by_b) connect(node.b.value, i, of_b);
        break;
      }
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

  /// Zero times what has no value would have none: where a factor is only taken where a sign says so, and the other
  /// need not exist, the product is taken as a whole.
  Signed product(Signed a, Signed b) {
    look_at_new_values();
    const bool exists_a = exists_[a.value.value], exists_b = exists_[b.value.value];
    if (is_taken_[a.value.value] && !exists_b) return inside(a, b);
    if (is_taken_[b.value.value] && !exists_a) return inside(b, a);
    return builder_.multiply(a, b);
  }

  /// `taken` times `factor`, which goes where no more signs decide.
  Signed inside(Signed taken, Signed factor) {
    const Node node = builder_.program()[taken.value];
    const Signed a{node.a}, b{node.b};
    Signed result;
    switch (node.op) {
      case Op::kNegate:
        result = -product(a, factor);
        break;
      case Op::kAdd:
        result = builder_.add(product(a, factor), product(b, factor));
        break;
      case Op::kSubtract:
        result = builder_.subtract(product(a, factor), product(b, factor));
        break;
      case Op::kMultiply:
        result = is_taken_[node.a.value] ? builder_.multiply(product(a, factor), b)
                                         : builder_.multiply(a, product(b, factor));
        break;
      default:
        result = builder_.function(function_of(node.op), a, product(b, factor));
    }
    return taken.negative ? -result : result;
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
      const bool is_parameter = node.leaf == LeafKind::kParameter || node.leaf == LeafKind::kConstant;
      fixed_.push_back(holds(fixed_, node.op == Op::kLiteral || is_parameter));
      const bool may_fail = (node.op == Op::kDivide && !fixed_[node.b.value]) || node.op == Op::kSqrt ||
                            (is_function(node.op) && !is_selection(node.op) && node.op != Op::kTanh);
      exists_.push_back(fixed_[i] || (holds(exists_, true) && !may_fail));
      const bool is_sum_or_product = node.op == Op::kAdd || node.op == Op::kSubtract ||
                                     node.op == Op::kMultiply || node.op == Op::kNegate;
      is_taken_.push_back(
          node.op == Op::kWhereNegative || node.op == Op::kWhereNotNegative ||
          (is_sum_or_product && (is_taken_[node.a.value] || (operands == 2 && is_taken_[node.b.value]))));
    }
  }

  Builder& builder_;
  std::vector<bool> exists_, fixed_, is_taken_;  ///< of the values so far
  std::size_t count_, columns_ = 0, rows_;
  std::vector<std::map<std::size_t, Signed>> operands_;  // of each vertex, with the partial derivative by it
  std::vector<std::set<std::size_t>> users_;
};

}  // namespace

JacobianEntries differentiate(Builder& builder, const std::vector<Signed>& values,
                              const std::vector<Seed>& seeds, EliminationOrder order) {
  return Graph(builder, values, seeds).eliminate(order);
}

}  // namespace jourdain::ir
