// What half the step changes: an estimate of a run's error, by a second run next to it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::commands {

/// The most that numbers of a unit differ by, of one run against another, at any time; infinite where one is no number.
/// "1": entries of quaternions.
struct UnitChange {
  std::string unit;
  double largest = 0;
};

/// Of a velocity, or of the entries of a quaternion, in one run against another, over time.
struct EntryChange {
  std::vector<std::size_t> entries;  ///< of x
  double square = 0, size = 0;       ///< sums of squares of the changes, and of the numbers themselves
  double largest = 0;                ///< of the changes; infinite where one is no number
  double energy = 0;                 ///< J, sum of the kinetic energies of the change alone; of velocities

  /// Root of the mean square, over that of the numbers; infinite where one is no number.
  double share() const;
};

/// The same run in steps of half the length, compared with it at the same times: after each of the first steps, then
/// evenly, whatever is written.
class HalvedRun {
 public:
  /// `h` is the step of the run of `count` steps that is judged, s; `units` are those of the entries of x, empty for
  /// those that are not looked at. What is referred to must live as long.
  HalvedRun(const studies::Flow<double>& flow, const jourdain_method& method, double h, long count,
            const std::vector<std::string>& units);

  /// Steps of the other run to the next comparison, once `done` are made; at least 1.
  long steps_to_next(long done) const;
  /// Goes on to where the other run is after `steps` more steps, and compares.
  void follow(const studies::Point<double>& point, long steps);

  /// By units, in the order of x.
  const std::vector<UnitChange>& changes() const { return changes_; }
  const std::vector<EntryChange>& entries() const { return entries_; }
  /// J, sum of the kinetic energies at the times of comparison, but no less than the energy that there is at the start
  /// and that is released would be over a hundred of them.
  double energies() const;
  /// Of comparisons.
  long times() const { return times_; }

 private:
  const studies::Flow<double>& flow_;
  const jourdain_method& method_;
  double h_ = 0;
  long stride_ = 1;
  std::vector<std::size_t> change_of_;  ///< for each entry of x
  std::vector<UnitChange> changes_;
  std::vector<EntryChange> entries_;
  studies::Point<double> point_;
  studies::Memory memory_;
  double start_ = 0, lowest_ = 0, highest_ = 0;  ///< J, kinetic energy at the start; of the potential energy
  double energies_ = 0;
  long done_ = 0, times_ = 0;
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

/// Half the step leads elsewhere where it changes a velocity, or a quaternion, by more than `accuracy` of what it is
/// (root mean squares over time). Then the run is wrong where the steps one by one, each against two of half the length
/// from where it begins, change it by as much, if that is added up. Otherwise small differences grow. Changes that move
/// nothing by more than rounding are none, nor are those of velocities that matter little in all that moves, by kinetic
/// energy, or to what relaxes: stiff motions, which implicit methods may leave unresolved. `units` of all of x.
HalvingVerdict judge_halving(const RunSteps& run, const HalvedRun& halved,
                             const std::vector<std::string>& units, double accuracy);

/// "half the step moves it by at most 2e-09 rad, 3e-08 rad/s".
std::string halving_text(const std::vector<UnitChange>& changes);

}  // namespace jourdain::commands
