#include "studies/spectra.hpp"

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

namespace jourdain::studies {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

Spectrum spectrum(const MatrixXd& A) {
  const Eigen::EigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXcd eigenvalues(const MatrixXd& A) { return Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues(); }

VectorXcd eigenvalues(const MatrixXcd& A) {
  return Eigen::ComplexEigenSolver<MatrixXcd>(A, false).eigenvalues();
}

Eigen::VectorXd singular_values(const MatrixXcd& A) {
  return Eigen::JacobiSVD<MatrixXcd>(A).singularValues();
}

MatrixXcd inverse(const MatrixXcd& A) { return A.fullPivLu().inverse(); }

MatrixXd exponential(const MatrixXd& A) { return A.exp(); }

}  // namespace jourdain::studies
