// What single steps of emitted code cost in time, on this machine: measured, no bounds.
#pragma once

#include <optional>
#include <vector>

#include "studies/flow.hpp"
#include "studies/reference_solution.hpp"

namespace jourdain::studies {

/// Times of single steps, s, less what calling and reading the clock take.
struct Quantiles {
  long count = 0;
  double median = 0, q99 = 0, q999 = 0, worst = 0;
};

/// Nearest rank: the least sample that the share `q` of all does not exceed.
Quantiles quantiles_of(std::vector<double> samples);

struct StepCost {
  std::size_t method = 0;
  Quantiles warm;     ///< one after the other along the motion
  long restarts = 0;  ///< of warm steps: the motion began anew, as numbers were no longer finite
  Quantiles cold;  ///< each after data of twice the last cache's size, at most 384 MiB, was read and written
  /// Medians of steps from changed states over that from a state along the motion. Velocities whose products
  /// are subnormal:
  double subnormal = 0;
  std::optional<double> flushed;            ///< those flushed to zero; where the processor can
  std::optional<double> thousand, million;  ///< so many rad of whole turns on all angles; where there are any
};

struct StepCostOptions {
  double h = 1e-3;    ///< s
  long warm = 20000;  ///< steps of each method
  long cold = 50;
};

/// Least time that the clock tells from none, s.
double clock_tick();

/// Bytes of the last-level cache as the system tells; 0: it does not.
std::size_t last_cache();

/// Bytes read and written to evict a state: twice the last-level cache, of a usual one where the system does not tell,
/// but at most 384 MiB, after which a larger cache may still hold it.
std::size_t evicting_bytes();

/// Velocity (rad/s, m/s) whose square is subnormal in numbers of that unit roundoff: 1e-160 in double, 1e-20 in float.
double faint_velocity(double unit_roundoff);

/// For every method of the table; inputs are those of the start, held. `angular` tells of each position
/// whether it is an angle.
std::vector<StepCost> measure_step_costs(const Flow<double>& flow, const std::vector<bool>& angular,
                                         const StepCostOptions& options, const Progress& progress);

}  // namespace jourdain::studies
