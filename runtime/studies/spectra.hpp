// Decompositions of and into complex matrices, and the matrix exponential, compiled once: see
// reference/decompositions.hpp. Complex matrices are taken as real ones of twice the size: Eigen's templates for them
// take fifteen seconds to compile.
#pragma once

#include <Eigen/Core>

namespace jourdain::studies {

/// Eigenvalues, which are not numbers where they are not found, and right eigenvectors, column by column of length 1.
struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
Spectrum spectrum(const Eigen::MatrixXd& A);

/// Largest absolute value of an eigenvalue.
double spectral_radius(const Eigen::MatrixXd& A);
double spectral_radius(const Eigen::MatrixXcd& A);

/// Largest first.
Eigen::VectorXd singular_values(const Eigen::MatrixXcd& A);
/// By LU with full pivoting.
Eigen::MatrixXcd inverse(const Eigen::MatrixXcd& A);
Eigen::MatrixXd exponential(const Eigen::MatrixXd& A);

}  // namespace jourdain::studies
