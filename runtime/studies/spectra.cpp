#include "studies/spectra.hpp"

#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/MatrixFunctions>

#include <cmath>

#include "reference/decompositions.hpp"

namespace jourdain::studies {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

namespace {

/// Of A over about its largest entry, so that nothing overflows; values that are not found are not numbers.
struct ScaledSpectrum {
  explicit ScaledSpectrum(const MatrixXd& A, bool with_vectors = true) {
    const double largest = A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0;
    const double scale = largest > 0 ? std::ldexp(1.0, std::ilogb(largest)) : 1;
    const Eigen::EigenSolver<MatrixXd> solver(A / scale, with_vectors);
    if (solver.info() == Eigen::Success) {
      values = scale * solver.eigenvalues();
      if (with_vectors) vectors = solver.eigenvectors();
      return;
    }
    values = VectorXcd::Constant(A.rows(), NAN);
    vectors = MatrixXcd::Identity(A.rows(), A.rows());
  }

  VectorXcd values;
  MatrixXcd vectors;
};

/// (Re −Im; Im Re): what it does to (Re x; Im x) is what A does to x.
MatrixXd real_form(const MatrixXcd& A) {
  MatrixXd real(2 * A.rows(), 2 * A.cols());
  real << A.real(), -A.imag(), A.imag(), A.real();
  return real;
}

}  // namespace

Spectrum spectrum(const MatrixXd& A) {
  const ScaledSpectrum scaled(A);
  return {scaled.values, scaled.vectors};
}

double spectral_radius(const MatrixXd& A) { return ScaledSpectrum(A, false).values.cwiseAbs().maxCoeff(); }

double spectral_radius(const MatrixXcd& A) { return spectral_radius(real_form(A)); }

Eigen::VectorXd singular_values(const MatrixXcd& A) {
  const Eigen::VectorXd twice = reference::singular_values<double>(real_form(A));
  return twice(Eigen::seqN(0, twice.size() / 2, 2));
}

MatrixXcd inverse(const MatrixXcd& A) {
  const Eigen::Index n = A.rows();
  const MatrixXd real = reference::pivoted_inverse<double>(real_form(A));
  MatrixXcd inverse(n, n);
  inverse.real() = real.topLeftCorner(n, n);
  inverse.imag() = real.bottomLeftCorner(n, n);
  return inverse;
}

MatrixXd exponential(const MatrixXd& A) { return A.exp(); }

}  // namespace jourdain::studies
