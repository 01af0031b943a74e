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
  std::vector<double> growth;  ///< largest separation at k intervals, over the initial one
  double exponent =
      0;  ///< of the growth over the whole time, 1/s: ln(growth)/t, estimates the Lyapunov exponent
};

/// Follows the trajectory and four near ones (seeded directions, brought near again after each interval), by `method`
/// with steps of length h; a whole number of which makes an interval. Shorter than `count` intervals where the motion
/// ends.
Divergence measure_divergence(const Flow<double>& flow, const jourdain_method& method, double h,
                              double interval, long count);

/// Number of intervals until nearby trajectories have separated by `factor`; all of them where they never do.
long intervals_until(const Divergence& divergence, double factor);

/// Transition matrices Φ(t_{k+1}, t_k), n × n, of the variational equation dX/dt = ∂f/∂x X along `points`, in double: Jacobians by
/// central differences, the classical Runge-Kutta method from point to point with substeps that resolve the Jacobian. With loops
/// each is followed by the derivative of the correction that steps end with: what opens the loops does not travel on.
std::vector<Eigen::MatrixXd> transition_matrices(const Flow<double>& flow,
                                                 const std::vector<Point<double>>& points);

/// ∂f/∂x, n × n, by central differences, entries moved by `separation` (1 + |x|).
Eigen::MatrixXd jacobian(const Flow<double>& flow, const Point<double>& point, double separation);

}  // namespace jourdain::studies
