// Where a method's error comes from. With Φ_h one step of the method, φ_h the exact flow and x(t) the exact solution
// (50 digits):
//
//   truncation    d_k = Φ_h(x(t_k)) − φ_h(x(t_k)), in 50 digits; of multistep methods with exact earlier rates
//   propagation   E_{k+1} = Φ(t_{k+1}, t_k) E_k + d_k with the transition matrices of the variational equation
//   rounding      the method in the working precision minus the method in 50 digits, same step, literals and start
//
// Each is computed by itself, none is a difference of the others. To first order the error at the end is E_N plus
// rounding.
#pragma once

#include <Eigen/Dense>

#include <vector>

#include "studies/flow.hpp"
#include "studies/reference_solution.hpp"

namespace jourdain::studies {

/// Positions (rad, m, entries of quaternions) and velocities (rad/s, m/s) apart: largest absolute entries.
struct ErrorNorms {
  double position = 0, velocity = 0;
};

struct ErrorSources {
  std::size_t method = 0;
  double h = 0;
  ErrorNorms truncation;  ///< sum of |d_k| over all steps
  ErrorNorms propagated;  ///< |E_N|
  ErrorNorms rounding;    ///< at the end
  ErrorNorms predicted;   ///< |E_N + rounding|
  ErrorNorms measured;    ///< working precision minus reference, at the end
  ErrorNorms difference;  ///< |E_N + rounding − (working precision minus reference)|
};

/// What one method and step need: `stride` of the reference's intervals make a step. `transitions` as from
/// transition_matrices at the reference's points.
ErrorSources error_sources(const Flow<double>& flow, const Flow<LongReal>& long_flow, std::size_t method,
                           const ReferenceSolution& reference,
                           const std::vector<Eigen::MatrixXd>& transitions, std::size_t stride);

/// |working precision minus 50 digits| at the end of `count` steps of length h.
ErrorNorms rounding_error(const Flow<double>& flow, const Flow<LongReal>& long_flow, std::size_t method,
                          double h, long count);

}  // namespace jourdain::studies
