// What half the step changes: an estimate of a run's error, by a second run next to it.
#pragma once

#include <string>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::commands {

/// Of all numbers of a unit, in one run against another, over time.
struct UnitChange {
  std::string unit;
  double largest = 0;           ///< of any of them at any time; infinite where one is no number
  double square = 0, size = 0;  ///< sums of squares of the changes, and of the numbers themselves
  double energy = 0;            ///< J, sum of the kinetic energies of the changes alone
  double energies = 0;          ///< J, sum of those of the motion
  double released = 0;          ///< J, most that the potential energy changes from one time to the next
  long times = 0;

  /// Root of the mean square, over that of the numbers; infinite where one is no number.
  double share() const;
};

/// The same run in steps of half the length, compared with it at the same times.
class HalvedRun {
 public:
  /// `h` is the step of the run that is judged, s; `units` are those of the entries of x, empty for those that are not
  /// looked at. What is referred to must live as long.
  HalvedRun(const studies::Flow<double>& flow, const jourdain_method& method, double h,
            const std::vector<std::string>& units);

  /// Goes on to where the other run is after `steps` more steps, and compares.
  void follow(const studies::Point<double>& point, long steps);

  /// By units, in the order of x.
  const std::vector<UnitChange>& changes() const { return changes_; }

 private:
  const studies::Flow<double>& flow_;
  const jourdain_method& method_;
  double h_ = 0;
  std::vector<std::size_t> change_of_;  ///< for each entry of x
  std::vector<UnitChange> changes_;
  studies::Point<double> point_;
  studies::Memory memory_;
  double potential_ = 0;  ///< J, when last looked at
  long done_ = 0;
};

/// A run of so many steps.
struct RunSteps {
  const studies::Flow<double>& flow;
  const jourdain_method& method;
  double h = 0;  ///< s
  long count = 0;
};

/// What half the step tells of a run.
struct HalvingVerdict {
  bool leads_elsewhere = false;  ///< half the step does
  std::string wrong;  ///< a sentence: why this is not the motion; empty: only the motion is sensitive
  studies::Point<double> point;  ///< where the step that errs most begins, if something is wrong
};

/// Half the step leads elsewhere where it changes the velocities of a unit by more than `accuracy` of what they are
/// (root mean squares over time). Then the run is wrong where the steps one by one, each against two of half the length
/// from where it begins, change them by as much, if that is added up. Otherwise small differences grow. Changes that
/// move nothing by more than rounding are none, nor are those that matter little in all that moves, by kinetic energy,
/// or to what relaxes: stiff motions, which implicit methods may leave unresolved. `velocities` are the units of z,
/// empty for those that are not looked at.
HalvingVerdict judge_halving(const RunSteps& run, const std::vector<UnitChange>& changes,
                             const std::vector<std::string>& velocities, double accuracy);

/// "half the step moves it by at most 2e-09 rad, 3e-08 rad/s".
std::string halving_text(const std::vector<UnitChange>& changes);

}  // namespace jourdain::commands
