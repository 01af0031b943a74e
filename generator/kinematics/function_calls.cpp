#include "kinematics/function_calls.hpp"

#include <cln/cln.h>

#include <array>
#include <string>

#include "support/scaled_real.hpp"

namespace jourdain::kinematics {

using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;
using support::Function;

namespace {

using Serials = std::array<unsigned, support::kFunctions>;

/// GiNaC's numbers of the functions.
const Serials& serials() {
  static const Serials made = [] {
    Serials list{};
    for (std::size_t i = 0; i < list.size(); ++i) {
      const support::FunctionFacts& facts = support::facts_of(static_cast<Function>(i));
      const auto operands = static_cast<unsigned>(facts.operands);
      list[i] = GiNaC::function::register_new(
          GiNaC::function_options("jourdain_" + std::string(facts.name), operands));
    }
    return list;
  }();
  return made;
}

cln::cl_R real(const Ex& number) { return cln::realpart(ex_to<numeric>(number).to_cl_N()); }

}  // namespace

Ex applied(Function function, const Ex& a, const Ex& b) {
  const bool is_unary = support::facts_of(function).operands == 1;
  const bool selects = function == Function::kWhereNegative || function == Function::kWhereNotNegative;
  if (selects && is_number(a))
    return cln::minusp(real(a)) == (function == Function::kWhereNegative) ? b : Ex(0);
  if (selects && b.is_zero()) return 0;
  if (function == Function::kAbs && is_number(a)) return cln::minusp(real(a)) ? Ex(-a) : a;
  if (function == Function::kMin && is_number(a) && is_number(b)) return real(b) < real(a) ? b : a;
  if (function == Function::kMax && is_number(a) && is_number(b)) return real(a) < real(b) ? b : a;
  if (!support::is_opaque(function) && is_number(a) && (is_unary || is_number(b))) {
    const support::ScaledReal value =
        support::value_of(function, support::ScaledReal(real(a)), support::ScaledReal(real(b)));
    if (value.is_number()) return numeric(cln::cl_N(cln::cl_R(value.value())));
  }
  const unsigned serial = serials()[static_cast<std::size_t>(function)];
  return is_unary ? Ex(GiNaC::function(serial, a)) : Ex(GiNaC::function(serial, a, b));
}

std::optional<Function> function_in(const Ex& call) {
  if (!is_a<GiNaC::function>(call)) return {};
  const unsigned serial = ex_to<GiNaC::function>(call).get_serial();
  for (std::size_t i = 0; i < support::kFunctions; ++i)
    if (serials()[i] == serial) return static_cast<Function>(i);
  return {};
}

}  // namespace jourdain::kinematics
