#include "lowering/lower.hpp"

#include <cln/cln.h>
#include <fmt/format.h>
#include <ginac/ginac.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "ir/builder.hpp"
#include "kinematics/function_calls.hpp"

namespace jourdain::lowering {

using ir::Builder;
using ir::Op;
using ir::Program;
using ir::Signed;

namespace {

using GiNaC::ex_to;
using GiNaC::is_a;
using kinematics::Ex;

cln::cl_R to_real(const Ex& number) { return cln::realpart(ex_to<GiNaC::numeric>(number).to_cl_N()); }

double to_double(const Ex& number) { return support::nearest_double(to_real(number)); }

/// Never iterated: the hashes change from run to run.
struct SymbolHash {
  std::size_t operator()(const GiNaC::symbol& s) const { return s.gethash(); }
};
struct SameSymbol {
  bool operator()(const GiNaC::symbol& a, const GiNaC::symbol& b) const { return a.is_equal(b); }
};
template <class Value>
using SymbolMap = std::unordered_map<GiNaC::symbol, Value, SymbolHash, SameSymbol>;

/// Text that orders operands: the same for an expression and its negative, and for every order of GiNaC's terms.
struct Key {
  std::string text;
  bool negative = false;

  friend bool operator<(const Key& a, const Key& b) { return a.text < b.text; }
};

struct Operand {
  Key key;
  Ex value;

  friend bool operator<(const Operand& a, const Operand& b) { return a.key < b.key; }
};

class Lowering {
 public:
  Lowering(const kinematics::Statements& statements, const std::vector<Target>& targets, Held held)
      : statements_(statements) {
    for (const auto& leaf : statements.leaves()) leaves_[leaf.symbol] = leaf;
    for (const auto& statement : statements.all())
      if (statement.held && held == Held::kLeaves)
        leaves_[statement.name] = {kinematics::LeafKind::kHeld, *statement.held, statement.name};
      else
        bound_[statement.name] = &statement.value;
    for (const Target& target : targets) need(target.value);
  }

  Program run(const std::vector<Target>& targets, std::string name) {
    for (const auto& statement : statements_.all()) {
      if (!needed_.count(statement.name)) continue;
      const Signed value = lower(statement.value);
      builder_.label(value.value, statement.name.get_name());
      lowered_[statement.name] = value;
    }
    for (const Target& target : targets)
      builder_.output(target.name, target.row, target.column, lower(target.value));
    return builder_.finish(std::move(name));
  }

 private:
  /// Marks the statements that `value` needs; iterative, because chains of statements are long.
  void need(const Ex& value) {
    std::vector<Ex> pending{value};
    while (!pending.empty()) {
      const Ex next = pending.back();
      pending.pop_back();
      if (is_a<GiNaC::symbol>(next)) {
        const auto it = bound_.find(ex_to<GiNaC::symbol>(next));
        if (it != bound_.end() && needed_.insert(it->first).second) pending.push_back(*it->second);
      }
      for (std::size_t i = 0; i < next.nops(); ++i) pending.push_back(next.op(i));
    }
  }

  Signed symbol(const GiNaC::symbol& s) {
    if (const auto it = lowered_.find(s); it != lowered_.end()) return it->second;
    const auto it = leaves_.find(s);
    JD_CHECK(it != leaves_.end(), "unbound symbol {}", s.get_name());
    return builder_.leaf(it->second.kind, it->second.index);
  }

  Key key(const Ex& e) {
    if (is_a<GiNaC::numeric>(e)) return {fmt::format("#{:a}", std::fabs(to_double(e))), to_double(e) < 0};
    if (is_a<GiNaC::symbol>(e)) return symbol_key(ex_to<GiNaC::symbol>(e));
    if (is_a<GiNaC::add>(e)) return sum_key(e);
    if (is_a<GiNaC::mul>(e)) return product_key(e);
    const Key argument = key(e.op(0));
    if (is_a<GiNaC::power>(e)) {
      const bool odd = e.op(1).info(GiNaC::info_flags::odd);
      return {fmt::format("(^{} {:a})", argument.text, to_double(e.op(1))), odd && argument.negative};
    }
    if (const auto function = kinematics::function_in(e)) return function_key(*function, e);
    const bool is_sine = is_ex_the_function(e, GiNaC::sin);
    return {fmt::format("({}{})", is_sine ? "sin" : "cos", argument.text), is_sine && argument.negative};
  }

  /// Signs inside belong to the function.
  Key function_key(support::Function function, const Ex& e) {
    Key call{fmt::format("({}", support::facts_of(function).name)};
    for (std::size_t i = 0; i < e.nops(); ++i) {
      const Key operand = key(e.op(i));
      call.text += (operand.negative ? " -" : " ") + operand.text;
    }
    call.text += ")";
    return call;
  }

  /// Not through `symbol`: that would number leaves in GiNaC's order.
  Key symbol_key(const GiNaC::symbol& s) const {
    const auto leaf = leaves_.find(s);
    if (leaf != leaves_.end()) return {fmt::format("{}{:08}", int(leaf->second.kind), leaf->second.index)};
    const Signed value = lowered_.at(s);
    return {fmt::format("v{:08}", value.value.value), value.negative};
  }

  Key sum_key(const Ex& e) {
    const auto [terms, negative] = sorted_terms(e);
    Key sum{"(", negative};
    for (const Operand& term : terms)
      sum.text += (term.key.negative == sum.negative ? "+" : "-") + term.key.text;
    sum.text += ")";
    return sum;
  }

  Key product_key(const Ex& e) {
    Key product;
    const char* separator = "";
    for (const Operand& factor : sorted_operands(e)) {
      product.negative = product.negative != factor.key.negative;
      if (factor.key.text == "#0x1p+0") continue;  // a mere sign
      product.text += separator + factor.key.text;
      separator = "*";
    }
    return product;
  }

  std::vector<Operand> sorted_operands(const Ex& e) {
    std::vector<Operand> operands;
    for (std::size_t i = 0; i < e.nops(); ++i) operands.push_back({key(e.op(i)), e.op(i)});
    std::stable_sort(operands.begin(), operands.end());
    return operands;
  }

  struct Terms {
    std::vector<Operand> operands;
    bool negative = false;  ///< the sign that is pulled out of the sum
  };

  /// Different names may stand for one value and its negative. Such terms have one key; the sign is that of
  /// the first ones that do not cancel, and terms with it come first.
  Terms sorted_terms(const Ex& e) {
    Terms terms{sorted_operands(e)};
    int surplus = 0;
    for (std::size_t i = 0; i < terms.operands.size() && surplus == 0; ++i)
      for (const Operand& term : terms.operands)
        if (term.key.text == terms.operands[i].key.text) surplus += term.key.negative ? -1 : 1;
    terms.negative = surplus < 0;
    std::stable_sort(terms.operands.begin(), terms.operands.end(), [&](const Operand& a, const Operand& b) {
      if (a.key.text != b.key.text) return a.key < b.key;
      return a.key.negative == terms.negative && b.key.negative != terms.negative;
    });
    return terms;
  }

  Signed lower(const Ex& e) {
    if (is_a<GiNaC::numeric>(e)) return builder_.literal(to_real(e));
    if (is_a<GiNaC::symbol>(e)) return symbol(ex_to<GiNaC::symbol>(e));
    if (is_a<GiNaC::add>(e)) return sum(e);
    if (is_a<GiNaC::mul>(e)) return product(e);
    if (is_a<GiNaC::power>(e)) return power(e.op(0), e.op(1));
    if (is_ex_the_function(e, GiNaC::sin)) return builder_.unary(Op::kSin, lower(e.op(0)));
    if (is_ex_the_function(e, GiNaC::cos)) return builder_.unary(Op::kCos, lower(e.op(0)));
    if (const auto function = kinematics::function_in(e)) {
      const Signed first = lower(e.op(0));
      return builder_.function(*function, first, e.nops() == 1 ? first : lower(e.op(1)));
    }
    JD_CHECK(false, "cannot lower '{}'", (std::ostringstream() << e).str());
    return {};
  }

  Signed sum(const Ex& e) {
    const std::vector<Operand> terms = sorted_terms(e).operands;
    Signed total = lower(terms[0].value);
    for (std::size_t i = 1; i < terms.size(); ++i) total = builder_.add(total, lower(terms[i].value));
    return total;
  }

  /// Symbolic factors in order, then the numeric one, then the denominator.
  Signed product(const Ex& e) {
    std::optional<Signed> numerator, denominator;
    const auto multiply = [this](std::optional<Signed>& side, Signed factor) {
      side = side ? builder_.multiply(*side, factor) : factor;
    };
    Ex coefficient = 1;
    for (const Operand& factor : sorted_operands(e)) {
      if (is_a<GiNaC::numeric>(factor.value))
        coefficient = coefficient * factor.value;
      else if (is_a<GiNaC::power>(factor.value) && factor.value.op(1).info(GiNaC::info_flags::negative))
        multiply(denominator, power(factor.value.op(0), -factor.value.op(1)));
      else
        multiply(numerator, lower(factor.value));
    }
    if (!numerator)
      numerator = builder_.literal(to_real(coefficient));
    else if (coefficient.is_equal(-1))
      numerator = -*numerator;
    else if (!coefficient.is_equal(1))
      numerator = builder_.multiply(*numerator, builder_.literal(to_real(coefficient)));
    return denominator ? builder_.divide(*numerator, *denominator) : *numerator;
  }

  Signed power(const Ex& base, const Ex& exponent) {
    JD_CHECK(is_a<GiNaC::numeric>(exponent), "exponent is not a number");
    if (ex_to<GiNaC::numeric>(exponent).is_negative()) {
      const Signed denominator = power(base, -exponent);
      return builder_.divide(builder_.literal(1), denominator);
    }
    const Ex twice = 2 * exponent;
    JD_CHECK(ex_to<GiNaC::numeric>(twice).is_integer(), "exponent {}", to_double(exponent));
    const int halves = ex_to<GiNaC::numeric>(twice).to_int();
    const Signed value = lower(base);
    std::optional<Signed> result;
    if (halves % 2) result = builder_.unary(Op::kSqrt, value);
    Signed square = value;  // value^(2^k)
    for (int n = halves / 2; n > 0; n /= 2) {
      if (n % 2) result = result ? builder_.multiply(*result, square) : square;
      if (n > 1) square = builder_.multiply(square, square);
    }
    return result ? *result : builder_.literal(1);
  }

  const kinematics::Statements& statements_;
  Builder builder_;
  SymbolMap<kinematics::Leaf> leaves_;
  SymbolMap<const Ex*> bound_;
  std::unordered_set<GiNaC::symbol, SymbolHash, SameSymbol> needed_;
  SymbolMap<Signed> lowered_;
};

}  // namespace

Program lower(const kinematics::Statements& statements, const std::vector<Target>& targets, std::string name,
              Held held) {
  return Lowering(statements, targets, held).run(targets, std::move(name));
}

}  // namespace jourdain::lowering
