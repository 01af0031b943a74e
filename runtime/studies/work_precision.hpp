// Error against run time of every method over a ladder of step sizes.
#pragma once

#include <optional>
#include <vector>

#include "studies/error_sources.hpp"
#include "studies/flow.hpp"
#include "studies/reference_solution.hpp"

namespace jourdain::studies {

/// Run time of one step, s, of interleaved repeats. The least is what counts: whatever else the machine does only adds.
struct StepTime {
  double least = 0, lower_quartile = 0, upper_quartile = 0;
};

/// One method and step size.
struct WorkPoint {
  std::size_t method = 0;
  double h = 0;  ///< s
  bool finite =
      true;  ///< never a thousand times the reference's positions off; the loops' closing was regular at every step
  ErrorNorms end;                             ///< at the end: rad, m; rad/s, m/s
  ErrorNorms largest;                         ///< along the way
  ErrorNorms relative_end, relative_largest;  ///< over the largest entry of the reference along the way
  std::optional<double> energy_drift;         ///< largest along the way, J; where the scene conserves energy
  double run_time = 0;                        ///< s per simulated second
  bool pareto = false;                        ///< no other point is both faster and more accurate
};

struct WorkPrecision {
  double duration = 0;                        ///< s
  std::vector<StepTime> step_times;           ///< by method
  std::vector<WorkPoint> points;              ///< method by method, from the longest step to the shortest
  std::vector<std::optional<double>> orders;  ///< by method: measured; none where no range of steps shows one
};

/// Largest differences of the first `positions` entries, and of the others.
ErrorNorms errors_at(const std::vector<double>& x, const std::vector<double>& reference,
                     std::size_t positions);

/// Least and quartiles of some samples.
StepTime spread_of(std::vector<double> samples);

/// Runs steps of length h and compares with the reference wherever they meet. `sampling` (s) is a multiple of h and of
/// the reference's interval.
WorkPoint measure_errors(const Flow<double>& flow, std::size_t method, double h, double sampling,
                         const ReferenceSolution& reference, bool conserves_energy);

/// Time of a step of each method of the table, from its start, inputs held; interleaved repeats of blocks that take a
/// millisecond at least.
std::vector<StepTime> measure_step_times(const jourdain_model_table& table, const Point<double>& start,
                                         const std::vector<double>& inputs, double h);

/// Steps (s, descending) longer than `sampling`, 2, 4, 8, … times as long or a little more: whole numbers of
/// them make the reference's time and whole numbers of its intervals a step. Ten steps at least.
std::vector<double> longer_steps(const ReferenceSolution& reference, double sampling);

/// Points for every method and every step of `steps` (s, descending). Errors of steps longer than `sampling`
/// are taken after each step.
WorkPrecision study_work_precision(const Flow<double>& flow, const std::vector<double>& steps,
                                   double sampling, const ReferenceSolution& reference, bool conserves_energy,
                                   const std::vector<double>& held_inputs, const Progress& progress);

/// Halves the shortest step `h` (s) as long as no point is within `tolerance` and the least error falls, 4096
/// steps an interval of `sampling` and `seconds` of nominal work at most. The steps that were added, descending.
std::vector<double> go_on_to_shorter_steps(WorkPrecision& study, double h, double tolerance,
                                           const Flow<double>& flow, double sampling,
                                           const ReferenceSolution& reference, bool conserves_energy,
                                           double seconds, const Progress& progress);

/// Measured orders and the Pareto front of the points as they are.
void judge_orders(WorkPrecision& study, const ReferenceSolution& reference);

/// Marks the points that no other one beats in both run time and largest position error.
void mark_pareto_front(std::vector<WorkPoint>& points);

/// Slope of log(error) over log(h) of the errors that are well above `floor`: extrapolated to h = 0 from the
/// two slopes at the shortest steps where these agree; otherwise of a line through the last five points, where
/// its standard error is below 0.3. `h` falls.
std::optional<double> measured_order(const std::vector<double>& h, const std::vector<double>& errors,
                                     double floor);

}  // namespace jourdain::studies
