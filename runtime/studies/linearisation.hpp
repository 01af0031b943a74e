// The linear system that small differences follow at one state, and its modes: what step limits are predicted from.
#pragma once

#include <Eigen/Dense>

#include <complex>
#include <vector>

#include "model/coordinates.hpp"
#include "studies/flow.hpp"

namespace jourdain::studies {

/// A = ∂(ẏ, ż)/∂(y, z) at `point`, positions first. A quaternion counts as a small rotation δθ, δquat = ½ quat ⊗ (0,
/// δθ), so that its length adds no mode. The axes are the body's at that moment and do not turn with it: in axes that
/// do, a fixed deviation seems to oscillate at |ω|, which no method has to survive. Position k is the one that velocity
/// k moves; behind those stand what is carried along. From the emitted derivatives where the table has them, else by
/// differences, with about 10 digits in double. Positions that depend on others follow them.
Eigen::MatrixXd linearisation(const Flow<double>& flow, const Point<double>& point,
                              const model::Tangent& tangent);

/// Eigenvalues µ (1/s) with their eigenvectors.
struct Modes {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd right;          ///< columns, in the coordinates of A
  Eigen::MatrixXd participations;  ///< share of each row of A in a mode; columns sum to 1
  Eigen::VectorXd scales;          ///< of the coordinates; balance A
  bool defective = false;          ///< eigenvectors as good as dependent: participations say little
};

Modes modes_of(const Eigen::MatrixXd& A);

/// Powers of two d such that rows and columns of diag(d)⁻¹ A diag(d) have like norms (Parlett and Reinsch).
Eigen::VectorXd balancing_scales(const Eigen::MatrixXd& A);

}  // namespace jourdain::studies
