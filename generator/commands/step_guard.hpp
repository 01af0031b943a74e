// Whether a step follows the motion: one that grows, as where a force pulls bodies together without bound, or one that
// the step throws off.
#pragma once

#include <string>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::commands {

/// A step is not believed where it throws a velocity off: changes it by more than any of that unit was before, and by
/// ten times as much as any changes at any time in parts of this step and the next, 64 and 250 of each. States are not
/// looked at. A step, but one of the first four, is not believed either where
/// - it changes a velocity by more than half of the largest that there was,
/// - before it this velocity grows by a quarter or more in a step, and its rate by exp(1/2),
/// - a mode grows by exp(1/2) in a step: stiff forces, which implicit methods may leave unresolved, have none, and
/// - a part of it, of 64, 250 or 1000 (none of the first four), changes it by more than half of the largest again; or
///   the parts lead elsewhere, and from there it grows three times as fast, by exp(2.5) in a step; or the step makes it
///   ten times as large as all that there was and as the parts do.
/// Otherwise the motion goes on, as where something slips. That is where motions end, which implicit methods step
/// across. Other steps that are too long are not found.
class StepGuard {
 public:
  /// `h` is the step, s, `units` are those of the entries of z; what is referred to must live as long.
  StepGuard(const studies::Flow<double>& flow, const jourdain_method& method, double h,
            std::vector<std::string> units);

  struct Problem {
    std::string what;        ///< a sentence; empty: nothing is wrong
    bool is_thrown = false;  ///< by the step; otherwise it grows
  };
  /// What is wrong with the step from `before` to `after`, one after the other from the start.
  Problem problem(const studies::Point<double>& before, const studies::Point<double>& after);

 private:
  /// A velocity, and how fast its rate grows exponentially, 1/s.
  struct Growth {
    std::size_t velocity = 0;
    double rate = 0;
  };
  struct Path {
    studies::Point<double> end;
    std::vector<double> changes;  ///< of each velocity, the largest on the way
    const Growth* jumped = nullptr;
  };
  struct Largest {
    double value = 0;
    std::size_t velocity = 0;
  };
  Largest largest(const std::string& unit, const std::vector<double>& values) const;
  /// Entries of z.
  std::vector<std::size_t> changed_much(const double* before, const double* after) const;
  void remember(const double* z);
  std::string thrown_off(const studies::Point<double>& before, const studies::Point<double>& after) const;
  std::string outgrown(const studies::Point<double>& before, const studies::Point<double>& after) const;
  std::vector<Growth> growing(const studies::Point<double>& point,
                              const std::vector<std::size_t>& velocities) const;
  double fastest_mode(const studies::Point<double>& point) const;
  Path in_parts(const studies::Point<double>& before, int parts, const std::vector<Growth>& growing,
                int steps = 1) const;
  double rounding() const;
  const Growth* lost(const studies::Point<double>& before, const studies::Point<double>& after,
                     const std::vector<Growth>& growing) const;

  const studies::Flow<double>& flow_;
  const jourdain_method& method_;
  double h_ = 0;
  std::vector<std::string> units_;
  std::vector<double> fastest_;  ///< by velocity, of all steps so far
  long steps_ = 0;
};

}  // namespace jourdain::commands
