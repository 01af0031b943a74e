#include "dynamics/high_precision.hpp"

#include <cln/cln.h>

#include <cstdlib>
#include <sstream>

#include "kinematics/function_calls.hpp"
#include "support/check.hpp"
#include "support/function_derivatives.hpp"

namespace jourdain::dynamics {

using GiNaC::ex_to;
using GiNaC::is_a;
using kinematics::Ex;

namespace {

using Slopes = std::vector<GradientReal::Slope>;

/// by_a a' + by_b b'
Slopes combined(const Slopes& a, const ScaledReal& by_a, const Slopes& b, const ScaledReal& by_b) {
  Slopes sum;
  sum.reserve(a.size() + b.size());
  auto in_a = a.begin(), in_b = b.begin();
  while (in_a != a.end() || in_b != b.end()) {
    const bool from_a = in_b == b.end() || (in_a != a.end() && in_a->variable <= in_b->variable);
    const bool from_b = in_a == a.end() || (in_b != b.end() && in_b->variable <= in_a->variable);
    const std::size_t variable = from_a ? in_a->variable : in_b->variable;
    ScaledReal by;
    if (from_a) by += by_a * (in_a++)->by;
    if (from_b) by += by_b * (in_b++)->by;
    sum.push_back({variable, by});
  }
  return sum;
}

}  // namespace

GradientReal operator+(const GradientReal& a, const GradientReal& b) {
  return {a.value + b.value, combined(a.slopes, 1, b.slopes, 1)};
}

GradientReal operator*(const GradientReal& a, const GradientReal& b) {
  return {a.value * b.value, combined(a.slopes, b.value, b.slopes, a.value)};
}

GradientReal operator/(const GradientReal& a, const GradientReal& b) {
  const ScaledReal ratio = a.value / b.value;
  return {ratio, combined(a.slopes, ScaledReal(1) / b.value, b.slopes, -ratio / b.value)};
}

GradientReal sqrt(const GradientReal& a) {
  const ScaledReal root = sqrt(a.value);
  return {root, combined(a.slopes, ScaledReal(1) / (ScaledReal(2) * root), {}, 0)};
}

GradientReal sin(const GradientReal& a) { return {sin(a.value), combined(a.slopes, cos(a.value), {}, 0)}; }

GradientReal cos(const GradientReal& a) { return {cos(a.value), combined(a.slopes, -sin(a.value), {}, 0)}; }

namespace {

struct Partials {
  ScaledReal value, by_a, by_b;
};

/// Of what is taken from `a` as it is, or from `b`, or from neither: the value and which.
Partials chosen(support::Function function, const ScaledReal& a, const ScaledReal& b) {
  using support::Function;
  const bool is_negative = a < ScaledReal(0);
  const ScaledReal value = value_of(function, a, b);
  switch (function) {
    case Function::kAbs:
      return {value, is_negative ? -1 : 1, 0};
    case Function::kMin:
      return b < a ? Partials{value, 0, 1} : Partials{value, 1, 0};
    case Function::kMax:
      return a < b ? Partials{value, 0, 1} : Partials{value, 1, 0};
    case Function::kWhereNegative:
      return {value, 0, is_negative ? 1 : 0};
    case Function::kWhereNotNegative:
      return {value, 0, is_negative ? 0 : 1};
    default:
      return {value, 0, 0};
  }
}

Partials partials_of(support::Function function, const ScaledReal& a, const ScaledReal& b, bool b_moves) {
  const support::FunctionFacts& facts = support::facts_of(function);
  if (facts.has_kinks) return chosen(function, a, b);
  if (facts.operands == 1) {
    const auto curve = support::curve_of(function, a, ScaledReal(1));
    return {curve.value, curve.slope, 0};
  }
  if (function == support::Function::kPower && !b_moves) {
    const auto curve = support::power_of(a, b, ScaledReal(1));
    return {curve.value, curve.slope, 0};
  }
  const auto surface = support::surface_of(function, a, b, ScaledReal(1));
  return {surface.value, surface.by_a, surface.by_b};
}

/// A derivative is selected, never multiplied by zero: it need not exist where the value is not taken.
bool is_taken(const ScaledReal& partial) { return partial != ScaledReal(0); }

}  // namespace

SlopeReal value_of(support::Function function, const SlopeReal& a, const SlopeReal& b) {
  const Partials f = partials_of(function, a.value, b.value, b.moves());
  const ScaledReal from_a = is_taken(f.by_a) && a.moves() ? f.by_a * a.first : ScaledReal(0);
  return {f.value, is_taken(f.by_b) && b.moves() ? from_a + f.by_b * b.first : from_a};
}

GradientReal value_of(support::Function function, const GradientReal& a, const GradientReal& b) {
  const Partials f = partials_of(function, a.value, b.value, !b.slopes.empty());
  return {f.value, combined(is_taken(f.by_a) ? a.slopes : Slopes(), f.by_a,
                            is_taken(f.by_b) ? b.slopes : Slopes(), f.by_b)};
}

template <class Number>
Evaluation<Number>::Evaluation(const kinematics::Statements& statements, const LeafValue& leaf,
                               const HeldValue& held) {
  for (const kinematics::Leaf& l : statements.leaves()) values_[l.symbol] = leaf(l.kind, l.index);
  for (const kinematics::Statement& statement : statements.all()) {
    Number number = value(statement.value);
    if (statement.held) {
      number = at_rest(number);
      if (held) number = held(*statement.held, number);
    }
    values_[statement.name] = number;
  }
}

template <class Number>
Number Evaluation<Number>::value(const Ex& e) const {
  if (is_a<GiNaC::numeric>(e)) return Number{ScaledReal(cln::realpart(ex_to<GiNaC::numeric>(e).to_cl_N()))};
  if (is_a<GiNaC::symbol>(e)) {
    const auto it = values_.find(ex_to<GiNaC::symbol>(e));
    JD_CHECK(it != values_.end(), "unbound symbol {}", ex_to<GiNaC::symbol>(e).get_name());
    return it->second;
  }
  if (is_a<GiNaC::add>(e) || is_a<GiNaC::mul>(e)) {
    Number total = value(e.op(0));
    for (std::size_t i = 1; i < e.nops(); ++i)
      total = is_a<GiNaC::add>(e) ? total + value(e.op(i)) : total * value(e.op(i));
    return total;
  }
  if (is_a<GiNaC::power>(e)) return power(e.op(0), e.op(1));
  if (is_ex_the_function(e, GiNaC::sin)) return sin(value(e.op(0)));
  if (is_ex_the_function(e, GiNaC::cos)) return cos(value(e.op(0)));
  if (const auto function = kinematics::function_in(e)) {
    using support::value_of;
    return value_of(*function, value(e.op(0)), value(e.op(e.nops() - 1)));
  }
  JD_CHECK(false, "cannot evaluate '{}'", (std::ostringstream() << e).str());
  return {};
}

template <class Number>
Number Evaluation<Number>::power(const Ex& base, const Ex& exponent) const {
  const GiNaC::numeric twice = ex_to<GiNaC::numeric>(Ex(2 * exponent));
  Number factor = value(base);
  if (twice.is_odd()) factor = sqrt(factor);
  const int count = twice.is_odd() ? twice.to_int() : twice.to_int() / 2;
  Number product{ScaledReal(1)};
  for (int i = 0; i < std::abs(count); ++i) product = product * factor;
  return count < 0 ? Number{ScaledReal(1)} / product : product;
}

template <class Number>
std::vector<Number> Evaluation<Number>::values(const std::vector<Ex>& expressions) const {
  std::vector<Number> list;
  for (const Ex& e : expressions) list.push_back(value(e));
  return list;
}

template class Evaluation<ScaledReal>;
template class Evaluation<MovingReal>;
template class Evaluation<SlopeReal>;
template class Evaluation<GradientReal>;

}  // namespace jourdain::dynamics
