#include "dynamics/high_precision.hpp"

#include <cln/cln.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "kinematics/numbers.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using GiNaC::ex_to;
using GiNaC::is_a;

namespace {

cln::cl_R to_real(const GiNaC::numeric& number) {
  return cln::cl_float(cln::realpart(number.to_cl_N()), cln::float_format(kinematics::kDigits));
}

}  // namespace

cln::cl_R to_exact(double value) { return to_real(ex_to<GiNaC::numeric>(kinematics::exact(value))); }

HighPrecision::HighPrecision(const kinematics::Statements& statements, const LeafValue& leaf) {
  evaluate(statements,
           [&leaf](kinematics::LeafKind kind, std::size_t index) { return to_exact(leaf(kind, index)); });
}

HighPrecision HighPrecision::at(const kinematics::Statements& statements, const ExactLeafValue& leaf) {
  HighPrecision result;
  result.evaluate(statements, leaf);
  return result;
}

void HighPrecision::evaluate(const kinematics::Statements& statements, const ExactLeafValue& leaf) {
  for (const kinematics::Leaf& l : statements.leaves()) values_[l.symbol] = leaf(l.kind, l.index);
  for (const kinematics::Statement& statement : statements.all())
    values_[statement.name] = value(statement.value);
}

cln::cl_R HighPrecision::value(const kinematics::Ex& e) const {
  if (is_a<GiNaC::numeric>(e)) return to_real(ex_to<GiNaC::numeric>(e));
  if (is_a<GiNaC::symbol>(e)) {
    const auto it = values_.find(ex_to<GiNaC::symbol>(e));
    JD_CHECK(it != values_.end(), "unbound symbol {}", ex_to<GiNaC::symbol>(e).get_name());
    return it->second;
  }
  if (is_a<GiNaC::add>(e) || is_a<GiNaC::mul>(e)) {
    cln::cl_R total = value(e.op(0));
    for (std::size_t i = 1; i < e.nops(); ++i)
      total = is_a<GiNaC::add>(e) ? total + value(e.op(i)) : total * value(e.op(i));
    return total;
  }
  if (is_a<GiNaC::power>(e)) {
    const GiNaC::numeric twice = ex_to<GiNaC::numeric>(kinematics::Ex(2 * e.op(1)));
    cln::cl_R base = value(e.op(0));
    if (twice.is_odd()) base = cln::sqrt(base);
    const int exponent = twice.is_odd() ? twice.to_int() : twice.to_int() / 2;
    return cln::expt(base, exponent);
  }
  if (is_ex_the_function(e, GiNaC::sin)) return cln::sin(value(e.op(0)));
  if (is_ex_the_function(e, GiNaC::cos)) return cln::cos(value(e.op(0)));
  JD_CHECK(false, "cannot evaluate '{}'", (std::ostringstream() << e).str());
  return 0;
}

double to_double(const cln::cl_R& value) {
  static const cln::cl_R smallest = std::numeric_limits<double>::min();
  if (cln::abs(value) >= smallest) return cln::double_approx(value);
  // CLN throws where a double is denormal or rounds to zero.
  constexpr int kShift = 200;
  const cln::cl_R shifted = value * cln::expt(cln::cl_I(2), kShift);
  return cln::abs(shifted) < smallest ? 0 : std::ldexp(cln::double_approx(shifted), -kShift);
}

}  // namespace jourdain::dynamics
