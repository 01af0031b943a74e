// Values of the symbolic statements in 60-digit CLN arithmetic: the yardstick for everything emitted.
#pragma once

#include <cln/real.h>

#include <functional>
#include <map>
#include <vector>

#include "kinematics/statements.hpp"

namespace jourdain::dynamics {

/// Value of a leaf (exact in double).
using LeafValue = std::function<double(kinematics::LeafKind, std::size_t index)>;

/// The statements evaluated at one state. No lowering, no pass, no program takes part.
class HighPrecision {
 public:
  HighPrecision(const kinematics::Statements& statements, const LeafValue& leaf);

  /// Value of a leaf, a bound name, a number or an expression of these.
  cln::cl_R value(const kinematics::Ex& expression) const;

 private:
  std::map<GiNaC::symbol, cln::cl_R, GiNaC::ex_is_less> values_;
};

/// Rounded to double (long double has no exact conversion from CLN).
double to_double(const cln::cl_R& value);

}  // namespace jourdain::dynamics
