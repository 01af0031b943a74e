// What a model's accelerations are worth far from where it usually is: velocities, angles and tunable parameters swept over
// many orders of magnitude, the working precision against 50 digits.
#pragma once

#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "studies/flow.hpp"
#include "studies/reference_solution.hpp"

namespace jourdain::studies {

/// Worst over some states of the trajectory, in units of rounding of the working precision.
struct ExtremePoint {
  double factor = 1;  ///< of the quantity; of angles: what is added, rad
  /// Worst row of M δż, δż the error of ż, over what rounding ż and the state once would change in it:
  /// Σ_j |M_ij| |ż_j| + Σ_k |∂r_i/∂x_k| |x_k| with r = M ż − k̄ + q̄.
  double backward = 0;
  double forward = 0;  ///< ‖δż‖ / ‖ż‖
  bool finite = true;  ///< accelerations are finite in the working precision; else the errors say nothing
};

struct ExtremeSweep {
  std::string quantity;  ///< "all velocities", "all angles", or a parameter
  std::vector<ExtremePoint> points;
};

/// One sweep of velocities (factors 1e-6 … 1e6), of angles (1 … 1e9 rad added to each), and of every tunable parameter
/// (1e-6 … 1e6 times its value). Empty where the table has no derivatives. The state is the same in both precisions. Afterwards both tables have `parameters` again.
std::vector<ExtremeSweep> study_extremes(const model::Mechanism& mechanism,
                                         const std::vector<double>& parameters, const Flow<double>& flow,
                                         const Flow<LongReal>& long_flow, const ReferenceSolution& reference,
                                         const Progress& progress);

}  // namespace jourdain::studies
