// Whether a step follows a motion that grows, as where a force pulls bodies together without bound.
#pragma once

#include <string>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::commands {

/// A step, but one of the first four, is not believed where
/// - it changes a velocity by more than half of the largest that there was,
/// - before it this velocity grows by a quarter or more in a step, and its rate by exp(1/2),
/// - its parts, 4, 16 or 64 of them, lead elsewhere, by more than a tenth of what it has changed, and
/// - a mode grows as fast: stiff forces, which implicit methods may leave unresolved, have none.
/// That is where motions end, which implicit methods step across. Other steps that are too long are not found.
class StepGuard {
 public:
  /// `h` is the step, s; what is referred to must live as long.
  StepGuard(const studies::Flow<double>& flow, const jourdain_method& method, double h);

  /// Of the step from `before` to `after`, one after the other from the start: a sentence; empty: nothing is wrong.
  std::string problem(const studies::Point<double>& before, const studies::Point<double>& after);

 private:
  std::vector<std::size_t> changed_much(const double* before, const double* after);
  double growth(const studies::Point<double>& point, const std::vector<std::size_t>& velocities) const;
  double fastest_mode(const studies::Point<double>& point) const;
  bool leads_elsewhere(const studies::Point<double>& before, const studies::Point<double>& after,
                       const std::vector<std::size_t>& velocities) const;

  const studies::Flow<double>& flow_;
  const jourdain_method& method_;
  double h_ = 0;
  std::vector<double> fastest_;  ///< by velocity, of all steps so far
  long steps_ = 0;
};

}  // namespace jourdain::commands
