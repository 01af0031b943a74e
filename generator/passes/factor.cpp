#include "passes/factor.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "passes/rewrite.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

namespace {

struct Term {
  ValueId value{};
  bool negative = false;
};

class Factoring {
 public:
  explicit Factoring(const Program& program)
      : program_(program), uses_(ir::use_counts(program)), copy_(program) {}

  Program run() {
    find_sums();
    const auto rewritten = [this](ValueId id) -> std::optional<Signed> {
      const auto sum = sums_.find(id.value);
      return sum == sums_.end() ? std::nullopt : std::optional(rebuild(sum->second));
    };
    return without_unused(copy_.run(rewritten, rebuilt_with_another_));
  }

 private:
  static bool is_sum(const Node& node) { return node.op == Op::kAdd || node.op == Op::kSubtract; }

  bool absorbed(ValueId id) const { return is_sum(program_[id]) && uses_[id.value] == 1; }

  /// Whole sums whose terms have a factor in common. All others stay as they are.
  void find_sums() {
    std::vector<bool> seen(program_.nodes.size(), false);
    rebuilt_with_another_.assign(program_.nodes.size(), false);
    for (std::size_t i = program_.nodes.size(); i-- > 0;) {
      if (!is_sum(program_.nodes[i]) || seen[i]) continue;
      std::vector<Term> terms;
      std::vector<ValueId> partial;
      collect(ValueId(i), false, terms, partial);
      for (const ValueId id : partial) seen[id.value] = true;
      for (const ValueId id : partial) rebuilt_with_another_[id.value] = true;
      sums_[i] = std::move(terms);
    }
  }

  /// Terms of a sum, and the partial sums on the way to them.
  void collect(ValueId id, bool negative, std::vector<Term>& terms, std::vector<ValueId>& partial) const {
    const Node& node = program_[id];
    const auto operand = [&](ValueId value, bool sign) {
      if (!absorbed(value)) return terms.push_back({value, sign});
      partial.push_back(value);
      collect(value, sign, terms, partial);
    };
    operand(node.a, negative);
    operand(node.b, negative != (node.op == Op::kSubtract));
  }

  bool factorable(const Term& term) const {
    return program_[term.value].op == Op::kMultiply && uses_[term.value.value] == 1;
  }

  /// The factor that most products of the sum share (the one declared first among equals), if any two do.
  std::optional<ValueId> common_factor(const std::vector<Term>& terms) const {
    std::map<ValueId, int> occurrences;
    for (const Term& term : terms) {
      if (!factorable(term)) continue;
      const Node& product = program_[term.value];
      ++occurrences[product.a];
      if (product.b != product.a) ++occurrences[product.b];
    }
    const auto best = std::max_element(occurrences.begin(), occurrences.end(),
                                       [](const auto& x, const auto& y) { return x.second < y.second; });
    if (best == occurrences.end() || best->second < 2) return std::nullopt;
    return best->first;
  }

  Signed signed_copy(ValueId value, bool negative) const { return negative ? -copy_[value] : copy_[value]; }

  Signed rebuild(const std::vector<Term>& terms) {
    const std::optional<ValueId> factor = common_factor(terms);
    std::vector<Term> rest;
    std::optional<Signed> cofactor;
    for (const Term& term : terms) {
      const Node& product = program_[term.value];
      if (!factor || !factorable(term) || (product.a != *factor && product.b != *factor)) {
        rest.push_back(term);
        continue;
      }
      const Signed other = signed_copy(product.a == *factor ? product.b : product.a, term.negative);
      cofactor = cofactor ? copy_.builder().add(*cofactor, other) : other;
    }
    if (!factor) return plain_sum(terms);
    const Signed grouped = copy_.builder().multiply(copy_[*factor], *cofactor);
    return rest.empty() ? grouped : copy_.builder().add(rebuild(rest), grouped);
  }

  Signed plain_sum(const std::vector<Term>& terms) {
    Signed sum = signed_copy(terms[0].value, terms[0].negative);
    for (std::size_t i = 1; i < terms.size(); ++i)
      sum = copy_.builder().add(sum, signed_copy(terms[i].value, terms[i].negative));
    return sum;
  }

  const Program& program_;
  std::vector<std::size_t> uses_;
  Copy copy_;
  std::map<std::size_t, std::vector<Term>> sums_;
  std::vector<bool> rebuilt_with_another_;
};

}  // namespace

Program factor(const Program& program) {
  const auto operations = [](const Program& p) { return ir::count_operations(p).arithmetic(); };
  Program best = remove_dead_code(program);
  for (;;) {
    Program next = Factoring(best).run();
    if (operations(next) >= operations(best)) return best;
    best = std::move(next);
  }
}

}  // namespace jourdain::passes
