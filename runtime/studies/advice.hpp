// Which method and step to take, confirmed by a run.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "studies/mode_limits.hpp"
#include "studies/work_precision.hpp"

namespace jourdain::studies {

/// What is asked for: the cheapest within `tolerance`, or the most accurate within `budget`.
struct Question {
  std::optional<double> tolerance;  ///< largest position error along the way, rad or m
  std::optional<double> budget;     ///< s of run time per `period`
  double period = 1e-3;       ///< s of simulated time; with a budget, whole numbers of steps make a period
  double longest = INFINITY;  ///< s; no longer step is tried, nor recommended
};

/// Is the step (s) none beyond the longest?
bool allows_step(const Question& question, double h);

/// Does the point keep within what is asked for? With a budget, whatever its step.
bool keeps_within(const Question& question, const WorkPoint& point);
/// Do whole numbers of steps of `h` (s) make the period?
bool divides_period(const Question& question, double h);

/// What is known of the motion beside the points of its study.
struct MotionFacts {
  std::vector<MethodLimit> limits;  ///< by method; empty: none is known
  double growth = 1;                ///< largest of differences along the way
};

struct Advice {
  std::size_t method = 0;
  double h = 0;
  ErrorNorms error;     ///< largest along the way, of the run that confirms it
  double compared = 0;  ///< every so many s: after each step, where a reference can be had there
  std::optional<ErrorNorms>
      error_held;          ///< of the same with each step's inputs held from its begin; none where that fails
  double run_time = 0;     ///< s per simulated second, measured with it
  double step_time = 0;    ///< s
  bool confirmed = false;  ///< error within the tolerance, run time within the budget
  std::optional<WorkPoint> runner_up;  ///< the other methods' point that answers best; none where none does
};

/// Nothing where no point of the study answers the question. None beyond a predicted limit does; within a tolerance,
/// none whose method misses it with a shorter step, by more than rounding and the reference can be off by. The step is
/// then made as long as the tolerance and the limit allow, each length tried, and two a little shorter: whole numbers
/// of steps make a sampling interval, or the whole time.
std::optional<Advice> advise(const Question& question, const WorkPrecision& study, const Flow<double>& flow,
                             double sampling, const ReferenceSolution& reference,
                             const std::vector<double>& held_inputs, const MotionFacts& facts = {});

}  // namespace jourdain::studies
