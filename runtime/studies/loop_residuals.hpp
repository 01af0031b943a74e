// How far the loops of a mechanism open while it moves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/advice.hpp"
#include "studies/flow.hpp"
#include "studies/work_precision.hpp"

namespace jourdain::studies {

/// Largest residuals over one run, after every step.
struct LoopRun {
  std::size_t method = 0;
  double h = 0;  ///< s
  long steps = 0;
  Residuals open;
  bool finite = true;  ///< false: up to the step that was not
};

/// From when on the loops' closing is singular or beyond what is proven, or constraints contradict each other.
struct Untrusted {
  double from = 0;  ///< s
  std::string why;  ///< "constraints contradict each other"
};

/// After the first step of `h` (s) over `duration` (s) by the table's first method whose closing is not to be trusted,
/// or leaves constraints open by more than `most_open` (m, rad); none where all are, and without loops.
std::optional<Untrusted> first_untrusted(const Flow<double>& flow, double h, double duration,
                                         double most_open);

/// Runs over `duration` (s) with the recommended step, and with ten times that step. Without a recommendation
/// the cheapest point of the study within 1e-6 (rad, m) takes its place, or the most accurate one. Empty where
/// there are no loops.
std::vector<LoopRun> study_loops(const Flow<double>& flow, const WorkPrecision& work, const Advice* advice,
                                 double duration);

}  // namespace jourdain::studies
