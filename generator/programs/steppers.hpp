// The steppers that can be emitted. A new one is its method in emit/explicit_step.cpp (or its coefficients in
// emit/rosenbrock.cpp) and one line in the list of steppers.cpp.
#pragma once

#include <string>
#include <vector>

namespace jourdain::programs {

/// A fixed-step method, emitted as `<name>_step`.
struct Stepper {
  std::string name;
  int order = 0;
  int evaluations = 0;            ///< of forward_dynamics per step; implicit: of residual
  int history = 0;                ///< earlier steps whose rates it remembers
  std::vector<std::string> uses;  ///< steppers that it calls
  std::string comment;            ///< a sentence for the declaration
  bool implicit = false;          ///< linearly implicit: remembers accelerations
  int reduced_order = 0;          ///< implicit: with derivatives that leave terms out; 0: needs them all

  /// With all derivatives, or with some left out.
  int order_with(bool all_derivatives) const { return all_derivatives || !implicit ? order : reduced_order; }
};

/// In the order of emission.
const std::vector<Stepper>& all_steppers();

/// Nothing where no stepper has the name.
const Stepper* find_stepper(const std::string& name);

}  // namespace jourdain::programs
