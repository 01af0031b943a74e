// What else one could integrate emitted code with, at the same error as the recommended step: CVODE and an adaptive
// Dormand-Prince pair on the emitted right-hand side, and semi-implicit Euler at 2 ms, as physics engines for
// games and learning step by default.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/advice.hpp"
#include "studies/flow.hpp"
#include "studies/work_precision.hpp"

namespace jourdain::studies {

/// One integrator over the whole judged time. Counts are exact and repeat, times are measured.
struct Alternative {
  std::string name;                 ///< "CVODE, BDF"; of the first row the method's
  std::optional<double> tolerance;  ///< its own relative one; none: of fixed step
  std::optional<double> h;          ///< s; none: it chooses
  ErrorNorms error;                 ///< largest along the way
  bool finished = false;            ///< the run came to its end; false: no numbers but the name's
  bool keeps = false;               ///< the error asked for
  long steps = 0;
  long calls = 0;        ///< of the right-hand side; linearly implicit steps: of the residual
  long worst_calls = 0;  ///< of one step
  StepTime run_time;     ///< s per simulated second, of whole runs
};

struct Alternatives {
  double error = 0;               ///< asked for: largest position error along the way, rad or m
  double compared = 0;            ///< s: interval at which errors are taken
  std::vector<Alternative> rows;  ///< the recommended step first; empty where nothing was recommended
};

/// Runs the recommended step, and each adaptive integrator at the loosest of its tolerances (10^(-k/3), k = 3,
/// 4, …, tried in this order) that keeps the error asked for: `tolerance`, or that of the recommended step.
/// Where none does within `seconds` of work the most accurate run stands in its place. Runs are timed in
/// turns, whole, inputs sampled as functions of time.
Alternatives study_alternatives(const Flow<double>& flow, const Advice& advice,
                                const std::optional<double>& tolerance, double sampling,
                                const ReferenceSolution& reference, double seconds, const Progress& progress);

/// Times over that of the recommended step.
double time_ratio(const Alternatives& study, const Alternative& row);

}  // namespace jourdain::studies
