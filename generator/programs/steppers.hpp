// The steppers that can be emitted. A new one is a template file of its name (or its
// coefficients) and one line in the list of steppers.cpp.
#pragma once

#include <string>
#include <vector>

namespace jourdain::programs {

/// A fixed-step method, emitted as `<name>_step` from the template `<name>_step.in`, or by the coefficients in
/// rosenbrock.cpp where it is linearly implicit.
struct Stepper {
  std::string name;
  int order = 0;
  int evaluations = 0;            ///< of forward_dynamics per step; implicit: of residual
  int history = 0;                ///< earlier steps whose rates it remembers
  std::vector<std::string> uses;  ///< steppers that its template calls
  long fixed_operations =
      0;  ///< per step, beside those per entry and the clock's; quotients of literals count as literals
  long entry_operations = 0;  ///< per step and entry of y and z
  std::string comment;        ///< a sentence for the declaration
  bool implicit = false;      ///< linearly implicit: remembers accelerations
  int reduced_order = 0;      ///< implicit: with derivatives that leave terms out; 0: needs them all

  /// With all derivatives, or with some left out.
  int order_with(bool all_derivatives) const { return all_derivatives || !implicit ? order : reduced_order; }
};

/// In the order of emission.
const std::vector<Stepper>& all_steppers();

/// Nothing where no stepper has the name.
const Stepper* find_stepper(const std::string& name);

/// Additions that move the clock once.
inline constexpr long kClockOperations = 7;

/// Operations per quaternion that bring it back to unit length.
inline constexpr long kNormaliseOperations = 14;

}  // namespace jourdain::programs
