// Decompositions that need complex numbers, and the matrix exponential, compiled once: see
// reference/decompositions.hpp.
#pragma once

#include <Eigen/Core>

namespace jourdain::studies {

/// Eigenvalues and right eigenvectors, column by column of length 1.
struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
Spectrum spectrum(const Eigen::MatrixXd& A);
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXcd& A);

/// Largest first.
Eigen::VectorXd singular_values(const Eigen::MatrixXcd& A);
/// By LU with full pivoting.
Eigen::MatrixXcd inverse(const Eigen::MatrixXcd& A);
Eigen::MatrixXd exponential(const Eigen::MatrixXd& A);

}  // namespace jourdain::studies
