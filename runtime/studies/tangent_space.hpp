// The small differences between states that keep the loops closed, in local coordinates.
#pragma once

#include <Eigen/Dense>

#include <vector>

#include "model/coordinates.hpp"
#include "studies/flow.hpp"

namespace jourdain::studies {

/// Directions in which positions that are not closed may be displaced: one for each entry of z, which may displace
/// nothing, then those of coordinates that are carried along, whose tangent's velocities are beyond z.
Eigen::Index displacement_count(const Flow<double>& flow, const model::Tangent& tangent);

/// Last entries of z that displace nothing: states beside the mechanism.
std::size_t still_velocities(const Flow<double>& flow, const model::Tangent& tangent);

/// Whether every position counts in `tangent` though there are loops: multipliers hold them closed.
bool keeps_all_coordinates(const Flow<double>& flow, const model::Tangent& tangent);

/// `point` moved by `delta` along the tangent's direction `velocity`; quaternions by a rotation, no loops closed.
Point<double> moved_along(const Point<double>& point, const model::Tangent& tangent, std::size_t velocity,
                          double delta);

/// Local coordinates of the closed states near one: some displacements and velocities of some entries of z. Where
/// constraints bind velocities alone there are more displacements than velocities.
struct LocalCoordinates {
  std::vector<std::size_t> displacements, velocities;  ///< directions; entries of z
  Eigen::MatrixXd embedding;           ///< all displacements, then velocities, by the coordinates
  Eigen::Index all_displacements = 0;  ///< rows of the embedding that are of displacements

  /// Displacements, then velocities.
  std::vector<std::size_t> rows() const;
};

/// Of a scene with all coordinates: those entries whose rows of the correction's derivative, by differences, are most
/// independent. Of others all entries.
LocalCoordinates local_coordinates(const Flow<double>& flow, const Point<double>& point,
                                   const model::Tangent& tangent);

/// Derivative of the correction that steps end with by the entries of x, n × n, by central differences; the identity
/// where there are no loops.
Eigen::MatrixXd correction_jacobian(const Flow<double>& flow, const Point<double>& point);

/// ½ quat ⊗ (0, ·), 4 × 3: what small rotations do to a quaternion.
Eigen::Matrix<double, 4, 3> turning(const Eigen::Vector4d& quaternion);

}  // namespace jourdain::studies
