#include "dynamics/high_precision.hpp"

#include <cln/cln.h>

#include <cstdlib>
#include <sstream>

#include "support/check.hpp"

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

template <class Number>
Evaluation<Number>::Evaluation(const kinematics::Statements& statements, const LeafValue& leaf) {
  for (const kinematics::Leaf& l : statements.leaves()) values_[l.symbol] = leaf(l.kind, l.index);
  for (const kinematics::Statement& statement : statements.all())
    values_[statement.name] = value(statement.value);
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
