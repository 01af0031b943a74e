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
struct ExHash {
  std::size_t operator()(const Ex& e) const { return e.gethash(); }
};
struct SameEx {
  bool operator()(const Ex& a, const Ex& b) const { return a.is_equal(b); }
};
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
};

/// An expression as it is lowered: operands in the order of their keys, each key told once.
struct Operand {
  Ex value;
  Key key;
  std::vector<Operand> operands;  ///< of powers the base alone

  friend bool operator<(const Operand& a, const Operand& b) { return a.key.text < b.key.text; }
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

  /// Telling a number's double takes longer than finding it again.
  struct Number {
    Key key;
    std::optional<Signed> literal;  ///< where it was lowered
  };
  Number& number(const Ex& e) {
    const auto [it, is_new] = numbers_.try_emplace(e);
    if (is_new) {
      const double value = to_double(e);
      it->second.key = {fmt::format("#{:a}", std::fabs(value)), value < 0};
    }
    return it->second;
  }
  Signed literal(const Ex& e) {
    Number& known = number(e);
    if (!known.literal) known.literal = builder_.literal(to_real(e));
    return *known.literal;
  }

  Operand sorted(const Ex& e) {
    Operand result{e, {}, {}};
    if (is_a<GiNaC::numeric>(e)) {
      result.key = number(e).key;
    } else if (is_a<GiNaC::symbol>(e)) {
      result.key = symbol_key(ex_to<GiNaC::symbol>(e));
    } else if (is_a<GiNaC::add>(e)) {
      sort_sum(result);
    } else if (is_a<GiNaC::mul>(e)) {
      sort_product(result);
    } else if (is_a<GiNaC::power>(e)) {
      result.operands.push_back(sorted(e.op(0)));
      const Key& base = result.operands[0].key;
      const bool odd = e.op(1).info(GiNaC::info_flags::odd);
      result.key = {fmt::format("(^{} {:a})", base.text, to_double(e.op(1))), odd && base.negative};
    } else {
      sort_call(result);
    }
    return result;
  }

  void sort_call(Operand& call) {
    for (std::size_t i = 0; i < call.value.nops(); ++i) call.operands.push_back(sorted(call.value.op(i)));
    if (const auto function = kinematics::function_in(call.value)) {
      // Signs inside belong to the function.
      call.key.text = fmt::format("({}", support::facts_of(*function).name);
      for (const Operand& operand : call.operands)
        call.key.text += (operand.key.negative ? " -" : " ") + operand.key.text;
      call.key.text += ")";
      return;
    }
    const bool is_sine = is_ex_the_function(call.value, GiNaC::sin);
    const Key& argument = call.operands[0].key;
    call.key = {fmt::format("({}{})", is_sine ? "sin" : "cos", argument.text), is_sine && argument.negative};
  }

  /// Not through `symbol`: that would number leaves in GiNaC's order.
  Key symbol_key(const GiNaC::symbol& s) const {
    const auto leaf = leaves_.find(s);
    if (leaf != leaves_.end()) return {fmt::format("{}{:08}", int(leaf->second.kind), leaf->second.index)};
    const Signed value = lowered_.at(s);
    return {fmt::format("v{:08}", value.value.value), value.negative};
  }

  std::vector<Operand> sorted_operands(const Ex& e) {
    std::vector<Operand> operands;
    operands.reserve(e.nops());
    for (std::size_t i = 0; i < e.nops(); ++i) operands.push_back(sorted(e.op(i)));
    std::stable_sort(operands.begin(), operands.end());
    return operands;
  }

  /// Different names may stand for one value and its negative. Such terms have one key; the sign that is pulled out of
  /// the sum is that of the first ones that do not cancel, and terms with it come first.
  void sort_sum(Operand& sum) {
    std::vector<Operand>& terms = sum.operands = sorted_operands(sum.value);
    int surplus = 0;
    for (std::size_t i = 0; i < terms.size() && surplus == 0; ++i)
      for (const Operand& term : terms)
        if (term.key.text == terms[i].key.text) surplus += term.key.negative ? -1 : 1;
    const bool negative = sum.key.negative = surplus < 0;
    std::stable_sort(terms.begin(), terms.end(), [negative](const Operand& a, const Operand& b) {
      if (a.key.text != b.key.text) return a < b;
      return a.key.negative == negative && b.key.negative != negative;
    });
    sum.key.text = "(";
    for (const Operand& term : terms)
      sum.key.text += (term.key.negative == negative ? "+" : "-") + term.key.text;
    sum.key.text += ")";
  }

  void sort_product(Operand& product) {
    product.operands = sorted_operands(product.value);
    const char* separator = "";
    for (const Operand& factor : product.operands) {
      product.key.negative = product.key.negative != factor.key.negative;
      if (factor.key.text == "#0x1p+0") continue;  // a mere sign
      product.key.text += separator + factor.key.text;
      separator = "*";
    }
  }

  Signed lower(const Ex& e) { return lower(sorted(e)); }

  Signed lower(const Operand& e) {
    if (is_a<GiNaC::numeric>(e.value)) return literal(e.value);
    if (is_a<GiNaC::symbol>(e.value)) return symbol(ex_to<GiNaC::symbol>(e.value));
    if (is_a<GiNaC::add>(e.value)) return sum(e.operands);
    if (is_a<GiNaC::mul>(e.value)) return product(e.operands);
    if (is_a<GiNaC::power>(e.value)) return power(e.operands[0], e.value.op(1));
    if (is_ex_the_function(e.value, GiNaC::sin)) return builder_.unary(Op::kSin, lower(e.operands[0]));
    if (is_ex_the_function(e.value, GiNaC::cos)) return builder_.unary(Op::kCos, lower(e.operands[0]));
    if (const auto function = kinematics::function_in(e.value)) {
      const Signed first = lower(e.operands[0]);
      return builder_.function(*function, first, e.operands.size() == 1 ? first : lower(e.operands[1]));
    }
    JD_CHECK(false, "cannot lower '{}'", (std::ostringstream() << e.value).str());
    return {};
  }

  Signed sum(const std::vector<Operand>& terms) {
    Signed total = lower(terms[0]);
    for (std::size_t i = 1; i < terms.size(); ++i) total = builder_.add(total, lower(terms[i]));
    return total;
  }

  /// Symbolic factors in order, then the numeric one, then the denominator.
  Signed product(const std::vector<Operand>& factors) {
    std::optional<Signed> numerator, denominator;
    const auto multiply = [this](std::optional<Signed>& side, Signed factor) {
      side = side ? builder_.multiply(*side, factor) : factor;
    };
    Ex coefficient = 1;
    for (const Operand& factor : factors) {
      if (is_a<GiNaC::numeric>(factor.value))
        coefficient = coefficient * factor.value;
      else if (is_a<GiNaC::power>(factor.value) && factor.value.op(1).info(GiNaC::info_flags::negative))
        multiply(denominator, power(factor.operands[0], -factor.value.op(1)));
      else
        multiply(numerator, lower(factor));
    }
    if (!numerator)
      numerator = literal(coefficient);
    else if (coefficient.is_equal(-1))
      numerator = -*numerator;
    else if (!coefficient.is_equal(1))
      numerator = builder_.multiply(*numerator, literal(coefficient));
    return denominator ? builder_.divide(*numerator, *denominator) : *numerator;
  }

  Signed power(const Operand& base, const Ex& exponent) {
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
  std::unordered_map<Ex, Number, ExHash, SameEx> numbers_;
};

}  // namespace

Program lower(const kinematics::Statements& statements, const std::vector<Target>& targets, std::string name,
              Held held) {
  return Lowering(statements, targets, held).run(targets, std::move(name));
}

}  // namespace jourdain::lowering
