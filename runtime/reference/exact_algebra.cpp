#include "reference/exact_algebra.hpp"

namespace jourdain::reference {

using support::ScaledReal;

namespace {

/// Brings A to upper triangular form, B along with it; the sign that exchanges of rows give the determinant.
int eliminate(ExactMatrix& A, ExactMatrix& B) {
  int sign = 1;
  for (Eigen::Index k = 0; k < A.rows(); ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < A.rows(); ++i)
      if (abs(A(i, k)) > abs(A(pivot, k))) pivot = i;
    if (pivot != k) {
      A.row(k).swap(A.row(pivot));
      B.row(k).swap(B.row(pivot));
      sign = -sign;
    }
    for (Eigen::Index i = k + 1; i < A.rows(); ++i) {
      if (A(i, k) == ScaledReal()) continue;
      const ScaledReal factor = A(i, k) / A(k, k);
      for (Eigen::Index j = k + 1; j < A.cols(); ++j) A(i, j) -= factor * A(k, j);
      for (Eigen::Index j = 0; j < B.cols(); ++j) B(i, j) -= factor * B(k, j);
    }
  }
  return sign;
}

}  // namespace

ExactMatrix solved(ExactMatrix A, ExactMatrix B) {
  eliminate(A, B);
  for (Eigen::Index k = A.rows(); k-- > 0;)
    for (Eigen::Index j = 0; j < B.cols(); ++j) {
      for (Eigen::Index i = k + 1; i < A.rows(); ++i) B(k, j) -= A(k, i) * B(i, j);
      B(k, j) /= A(k, k);
    }
  return B;
}

ScaledReal determinant(ExactMatrix A) {
  ExactMatrix nothing(A.rows(), 0);
  ScaledReal product = eliminate(A, nothing);
  for (Eigen::Index k = 0; k < A.rows(); ++k) product *= A(k, k);
  return product;
}

ExactVector to_exact(const std::vector<ScaledReal>& values) {
  return Eigen::Map<const ExactVector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

ExactMatrix to_exact(const std::vector<std::vector<ScaledReal>>& rows, std::size_t columns) {
  ExactMatrix matrix(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
  for (std::size_t r = 0; r < rows.size(); ++r)
    matrix.row(static_cast<Eigen::Index>(r)) = to_exact(rows[r]).transpose();
  return matrix;
}

std::vector<ScaledReal> to_list(const ExactVector& values) {
  return {values.data(), values.data() + values.size()};
}

}  // namespace jourdain::reference
