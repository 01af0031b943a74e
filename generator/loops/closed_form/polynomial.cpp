#include "loops/closed_form/polynomial.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace jourdain::loops {

using ir::LeafKind;
using ir::Node;
using ir::Op;
using ir::Program;
using ir::ValueId;

namespace {

class Expansion {
 public:
  Expansion(ir::Builder& builder, const Program& g, const Roles& roles)
      : builder_(builder),
        g_(g),
        roles_(roles),
        expanded_(g.nodes.size()),
        dependent_(g.nodes.size(), false) {}

  std::variant<std::vector<Polynomial>, std::string> run(const std::vector<ValueId>& values) {
    const std::vector<bool> needed = needed_by(values);
    for (std::size_t i = 0; i < g_.nodes.size() && failure_.empty(); ++i)
      if (needed[i]) expand(i);
    if (!failure_.empty()) return failure_;
    std::vector<Polynomial> polynomials;
    for (const ValueId value : values) {
      polynomials.push_back(expanded_[value.value]);
      if (has_quaternion(polynomials.back())) return "a constraint has a quaternion other than in a rotation";
    }
    return polynomials;
  }

 private:
  struct Pair {
    Polynomial sine, cosine;
  };

  std::vector<bool> needed_by(const std::vector<ValueId>& values) const {
    std::vector<bool> needed(g_.nodes.size(), false);
    for (const ValueId value : values) needed[value.value] = true;
    for (std::size_t i = g_.nodes.size(); i-- > 0;) {
      if (!needed[i]) continue;
      if (ir::operand_count(g_.nodes[i].op) >= 1) needed[g_.nodes[i].a.value] = true;
      if (ir::operand_count(g_.nodes[i].op) == 2) needed[g_.nodes[i].b.value] = true;
    }
    return needed;
  }

  Scalar scalar(ir::Signed value) const { return {&builder_, value}; }
  Polynomial literal(double value) const { return {{kConstant, scalar(builder_.literal(value))}}; }
  Polynomial monomial(const Monomial& powers) const { return {{powers, scalar(builder_.literal(1))}}; }

  static bool is_constant(const Polynomial& p) {
    return std::all_of(p.begin(), p.end(), [](const auto& term) { return term.first == kConstant; });
  }

  Scalar constant(const Polynomial& p) const {
    const auto it = p.find(kConstant);
    return it == p.end() ? scalar(builder_.literal(0)) : it->second;
  }

  static void add_term(Polynomial& sum, const Monomial& powers, Scalar coefficient) {
    const auto [it, is_new] = sum.try_emplace(powers, coefficient);
    if (!is_new) it->second = it->second + coefficient;
    if (is_zero(it->second)) sum.erase(it);
  }

  static Polynomial negated(Polynomial p) {
    for (auto& [powers, coefficient] : p) coefficient = -coefficient;
    return p;
  }

  static Polynomial sum(Polynomial a, const Polynomial& b) {
    for (const auto& [powers, coefficient] : b) add_term(a, powers, coefficient);
    return a;
  }

  static Polynomial product(const Polynomial& a, const Polynomial& b) {
    Polynomial result;
    for (const auto& [p, x] : a)
      for (const auto& [q, y] : b) add_reduced(result, p * q, x * y);
    return result;
  }

  /// With cos² + sin² = 1 and RᵀR = 1: of R no products of two entries of the last row are left.
  static void add_reduced(Polynomial& sum, Monomial powers, Scalar coefficient) {
    for (std::size_t unknown = 0; unknown < kScalars; ++unknown)
      if (powers[3 * unknown + 1] >= 2) {
        powers[3 * unknown + 1] -= 2;
        add_reduced(sum, powers, coefficient);
        return add_reduced(sum, powers * cos_of(unknown) * cos_of(unknown), -coefficient);
      }
    if (const auto columns = last_row_pair(powers)) {
      const auto [j, k] = *columns;
      --powers[kLastRow + j];
      --powers[kLastRow + k];
      if (j == k) add_reduced(sum, powers, coefficient);
      for (const std::size_t i : {0, 1})
        add_reduced(sum, powers * rotation_entry(i, j) * rotation_entry(i, k), -coefficient);
      return;
    }
    add_term(sum, powers, coefficient);
  }

  static constexpr std::size_t kQuaternion = 3 * kScalars, kLastRow = kQuaternion + 4 + 6;

  static std::optional<std::pair<std::size_t, std::size_t>> last_row_pair(const Monomial& powers) {
    std::vector<std::size_t> columns;
    for (std::size_t j = 0; j < 3; ++j)
      for (int n = powers[kLastRow + j]; n > 0; --n) columns.push_back(j);
    if (columns.size() < 2) return std::nullopt;
    return std::pair{columns[0], columns[1]};
  }

  /// R_ij as a polynomial of the quaternion: 1 − 2(y² + z²), 2(xy − wz), …
  Polynomial entry_of_quaternion(std::size_t i, std::size_t j) const {
    Polynomial p;
    const auto add = [&](std::size_t a, std::size_t b, double factor) {
      add_term(p, quaternion_entry(a) * quaternion_entry(b), scalar(builder_.literal(factor)));
    };
    if (i == j) {
      p = literal(1);
      for (std::size_t k = 0; k < 3; ++k)
        if (k != i) add(k + 1, k + 1, -2);
      return p;
    }
    const std::size_t other = 3 - i - j;
    add(std::min(i, j) + 1, std::max(i, j) + 1, 2);
    add(0, other + 1, j == (i + 1) % 3 ? -2 : 2);
    return p;
  }

  static bool is_same(const Polynomial& a, const Polynomial& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const auto& p, const auto& q) {
             return p.first == q.first && p.second.value.value == q.second.value.value &&
                    p.second.value.negative == q.second.value.negative;
           });
  }

  /// An entry of R where the polynomial is one, or minus one.
  Polynomial with_rotation(const Polynomial& p) const {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const Polynomial entry = entry_of_quaternion(i, j);
        if (is_same(p, entry)) return monomial(rotation_entry(i, j));
        if (is_same(p, negated(entry))) return negated(monomial(rotation_entry(i, j)));
      }
    return p;
  }

  static bool has_quaternion(const Polynomial& p) {
    return std::any_of(p.begin(), p.end(), [](const auto& term) {
      const auto first = term.first.begin() + kQuaternion;
      return std::any_of(first, first + 4, [](int n) { return n > 0; });
    });
  }

  Polynomial fail(const std::string& why) {
    if (failure_.empty()) failure_ = why;
    return {};
  }

  void expand(std::size_t i) {
    const Node& node = g_.nodes[i];
    const int operands = ir::operand_count(node.op);
    dependent_[i] =
        (operands >= 1 && dependent_[node.a.value]) || (operands == 2 && dependent_[node.b.value]);
    expanded_[i] = value(ValueId(i));
    if (has_quaternion(expanded_[i])) expanded_[i] = with_rotation(expanded_[i]);
  }

  Polynomial value(ValueId id) {
    const Node& node = g_[id];
    const Polynomial &a = expanded_[node.a.value], &b = expanded_[node.b.value];
    switch (node.op) {
      case Op::kLiteral:
        return {{kConstant, scalar(builder_.apply(node, {}, {}))}};
      case Op::kLeaf:
        return leaf(id);
      case Op::kNegate:
        return negated(a);
      case Op::kAdd:
        return sum(a, b);
      case Op::kSubtract:
        return sum(a, negated(b));
      case Op::kMultiply:
        return product(a, b);
      case Op::kDivide:
        if (!is_constant(b)) break;
        return quotient(a, constant(b));
      case Op::kSqrt:
        if (!is_constant(a)) break;
        return {{kConstant, square_root(constant(a))}};
      case Op::kSin:
        return pair_of(node.a).sine;
      case Op::kCos:
        return pair_of(node.a).cosine;
      default:
        if (!is_constant(a) || (ir::operand_count(node.op) == 2 && !is_constant(b))) break;
        const Scalar first = constant(a), second = ir::operand_count(node.op) == 2 ? constant(b) : first;
        return {{kConstant, applied(ir::function_of(node.op), first, second)}};
    }
    return fail(fmt::format("a constraint has {} of {}", ir::op_name(node.op), unknown_names()));
  }

  std::string unknown_names() const {
    std::string text;
    for (const std::size_t entry : roles_.unknowns)
      text += fmt::format("{}{}", text.empty() ? "" : " or ", roles_.names[entry]);
    return text;
  }

  static Polynomial quotient(Polynomial a, Scalar b) {
    for (auto& [powers, coefficient] : a) coefficient = coefficient / b;
    return a;
  }

  std::optional<std::size_t> unknown(const Node& node) const {
    if (node.op != Op::kLeaf || node.leaf != LeafKind::kPosition) return std::nullopt;
    const auto it = std::find(roles_.unknowns.begin(), roles_.unknowns.end(), node.index);
    if (it == roles_.unknowns.end()) return std::nullopt;
    return static_cast<std::size_t>(it - roles_.unknowns.begin());
  }

  const Known* known(const Node& node) const {
    if (node.op != Op::kLeaf || node.leaf != LeafKind::kPosition) return nullptr;
    const auto it = roles_.known.find(node.index);
    return it == roles_.known.end() ? nullptr : &it->second;
  }

  Polynomial leaf(ValueId id) {
    const Node& node = g_[id];
    if (node.leaf == LeafKind::kPosition && roles_.later.count(node.index))
      return fail(fmt::format("{} depends on {}, which is found after it", unknown_names(),
                              roles_.names[node.index]));
    if (const auto k = unknown(node)) {
      dependent_[id.value] = true;
      return monomial(value_of(*k));
    }
    if (node.leaf == LeafKind::kPosition && roles_.rotation && node.index - *roles_.rotation < 4) {
      dependent_[id.value] = true;
      return monomial(quaternion_entry(node.index - *roles_.rotation));
    }
    if (const Known* found = known(node)) {
      dependent_[id.value] = true;
      return {{kConstant, found->value}};
    }
    return {{kConstant, scalar(builder_.leaf(node.leaf, node.index))}};
  }

  Pair pair_of(ValueId id) {
    if (const auto it = pairs_.find(id); it != pairs_.end()) return it->second;
    return pairs_[id] = new_pair(id);
  }

  Pair new_pair(ValueId id) {
    const Node& node = g_[id];
    if (const auto k = unknown(node)) return {monomial(sin_of(*k)), monomial(cos_of(*k))};
    if (const Known* found = known(node); found && found->direction)
      return {{{kConstant, found->direction->y}}, {{kConstant, found->direction->x}}};
    if (dependent_[id.value] && node.op == Op::kNegate) {
      const Pair a = pair_of(node.a);
      return {negated(a.sine), a.cosine};
    }
    if (dependent_[id.value] && (node.op == Op::kAdd || node.op == Op::kSubtract)) {
      const Pair a = pair_of(node.a);
      Pair b = pair_of(node.b);
      if (node.op == Op::kSubtract) b.sine = negated(b.sine);
      const Polynomial products[] = {product(a.sine, b.cosine), product(a.cosine, b.sine),
                                     product(a.cosine, b.cosine), product(a.sine, b.sine)};
      return {sum(products[0], products[1]), sum(products[2], negated(products[3]))};
    }
    if (!is_constant(expanded_[id.value])) {
      fail(fmt::format("a constraint has the sine of a multiple of {}", unknown_names()));
      return {};
    }
    const Scalar angle = constant(expanded_[id.value]);
    return {{{kConstant, sine(angle)}}, {{kConstant, cosine(angle)}}};
  }

  ir::Builder& builder_;
  const Program& g_;
  const Roles& roles_;
  std::vector<Polynomial> expanded_;  ///< of each value of g
  std::vector<bool> dependent_;       ///< which of them need coordinates that blocks determine
  std::map<ValueId, Pair> pairs_;     ///< of angles
  std::string failure_;
};

}  // namespace

bool depends_on(const Polynomial& row, std::size_t unknown) {
  return std::any_of(row.begin(), row.end(), [unknown](const auto& term) {
    const Monomial& powers = term.first;
    return powers[3 * unknown] + powers[3 * unknown + 1] + powers[3 * unknown + 2] > 0;
  });
}

Polynomial substituted(const Polynomial& row, std::size_t unknown, const Known& found) {
  Polynomial result;
  for (const auto& [powers, coefficient] : row) {
    Scalar factor = coefficient;
    Monomial rest = powers;
    std::fill(rest.begin(), rest.begin() + 3 * kScalars, 0);
    for (std::size_t k = 0; k < 3 * kScalars; ++k) {
      if (k / 3 != unknown) {
        rest[k / 3 > unknown ? k - 3 : k] = powers[k];
        continue;
      }
      const std::size_t i = k % 3;
      for (int n = powers[k]; n > 0; --n)
        factor = factor * (i == 0 ? found.direction->x : i == 1 ? found.direction->y : found.value);
    }
    const auto [it, is_new] = result.try_emplace(rest, factor);
    if (!is_new) it->second = it->second + factor;
  }
  return result;
}

std::variant<std::vector<Polynomial>, std::string> polynomials_of(ir::Builder& builder,
                                                                  const Program& program,
                                                                  const std::vector<ValueId>& values,
                                                                  const Roles& roles) {
  return Expansion(builder, program, roles).run(values);
}

}  // namespace jourdain::loops
