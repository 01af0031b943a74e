// How the motion carries differences along: growth of nearby trajectories, transition matrices.
#pragma once

#include <Eigen/Dense>

#include <optional>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::studies {

/// Separation of nearby trajectories.
struct Divergence {
  double interval = 0;         ///< s
  std::vector<double> growth;  ///< at k intervals
  double exponent =
      0;  ///< of the growth over the whole time, 1/s: ln(growth)/t, estimates the Lyapunov exponent
};

/// Largest distance of the positions (2-norm over rad, m, entries of quaternions) of four motions that start
/// near the reference, over the distance at the start, where velocities count by `rate`⁻¹ (s; how fast the
/// motion itself is); at every `interval` (s, a multiple of the reference's). Solutions by CVODE, brought near
/// again after each interval: no stepper takes part. Shorter where CVODE gives up.
Divergence measure_divergence(const Flow<double>& flow, const std::vector<Point<double>>& reference,
                              double interval, double rate);

/// Transition matrices Φ(t_{k+1}, t_k), n × n, of the variational equation dX/dt = ∂f/∂x X along `points`, in
/// double: Jacobians by central differences, from point to point the classical Runge-Kutta method with
/// substeps that resolve the Jacobian. Where that takes too many, exponentials of the Jacobians between the
/// two points, which are stable however stiff the scene is. With loops each is followed by the derivative of
/// the correction that steps end with: what opens the loops does not travel on.
std::vector<Eigen::MatrixXd> transition_matrices(const Flow<double>& flow,
                                                 const std::vector<Point<double>>& points);

/// ∂f/∂x, n × n, by central differences, entries moved by `separation` (1 + |x|).
Eigen::MatrixXd jacobian(const Flow<double>& flow, const Point<double>& point, double separation);
/// The same, entry by entry moved by `changes`.
Eigen::MatrixXd jacobian(const Flow<double>& flow, const Point<double>& point,
                         const std::vector<double>& changes);

}  // namespace jourdain::studies
