// Whether a step follows a motion that grows, as where a force pulls bodies together without bound.
#pragma once

#include <string>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::commands {

/// A step, but one of the first four, is not believed where
/// - it changes a velocity by more than half of the largest that there was,
/// - before it this velocity grows by a quarter or more in a step, and its rate by exp(1/2),
/// - a mode grows by exp(1/2) in a step: stiff forces, which implicit methods may leave unresolved, have none, and
/// - a part of it, of 64, 250 or 1000 (none of the first four), changes it by more than half of the largest again; or
///   the parts lead elsewhere, and from there it grows three times as fast, by exp(2.5) in a step; or the step makes it
///   ten times as large as all that there was and as the parts do.
/// Otherwise the motion goes on, as where something slips. That is where motions end, which implicit methods step
/// across.
class StepGuard {
 public:
  /// `h` is the step, s; what is referred to must live as long.
  StepGuard(const studies::Flow<double>& flow, const jourdain_method& method, double h);

  /// What is wrong with the step from `before` to `after`, one after the other from the start, a sentence; empty:
  /// nothing.
  std::string problem(const studies::Point<double>& before, const studies::Point<double>& after);

 private:
  /// A velocity, and how fast its rate grows exponentially, 1/s.
  struct Growth {
    std::size_t velocity = 0;
    double rate = 0;
  };
  struct Path {
    studies::Point<double> end;
    const Growth* jumped = nullptr;
  };
  /// Entries of z.
  std::vector<std::size_t> changed_much(const double* before, const double* after) const;
  void remember(const double* z);
  std::string outgrown(const studies::Point<double>& before, const studies::Point<double>& after) const;
  std::vector<Growth> growing(const studies::Point<double>& point,
                              const std::vector<std::size_t>& velocities) const;
  double fastest_mode(const studies::Point<double>& point) const;
  Path in_parts(const studies::Point<double>& before, int parts, const std::vector<Growth>& growing) const;
  double rounding() const;
  const Growth* lost(const studies::Point<double>& before, const studies::Point<double>& after,
                     const std::vector<Growth>& growing) const;

  const studies::Flow<double>& flow_;
  const jourdain_method& method_;
  double h_ = 0;
  std::vector<double> fastest_;  ///< by velocity, of all steps so far
  long steps_ = 0;
};

}  // namespace jourdain::commands
