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
/// The same with 60 digits.
using ExactLeafValue = std::function<cln::cl_R(kinematics::LeafKind, std::size_t index)>;

/// A double with 60 digits.
cln::cl_R to_exact(double value);

/// The statements evaluated at one state. No lowering, no pass, no program takes part.
class HighPrecision {
 public:
  HighPrecision(const kinematics::Statements& statements, const LeafValue& leaf);
  static HighPrecision at(const kinematics::Statements& statements, const ExactLeafValue& leaf);

  /// Value of a leaf, a bound name, a number or an expression of these.
  cln::cl_R value(const kinematics::Ex& expression) const;

 private:
  HighPrecision() = default;
  void evaluate(const kinematics::Statements& statements, const ExactLeafValue& leaf);

  std::map<GiNaC::symbol, cln::cl_R, GiNaC::ex_is_less> values_;
};

/// Rounded to double (long double has no exact conversion from CLN).
double to_double(const cln::cl_R& value);

}  // namespace jourdain::dynamics
