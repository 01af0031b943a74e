#include "dynamics/high_precision.hpp"

#include <cln/cln.h>

#include <cstdlib>
#include <sstream>

#include "support/check.hpp"

namespace jourdain::dynamics {

using GiNaC::ex_to;
using GiNaC::is_a;
using kinematics::Ex;

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

}  // namespace jourdain::dynamics
