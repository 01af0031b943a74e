#include "reference/decompositions.hpp"

#include <Eigen/Dense>

namespace jourdain::reference {

namespace {

template <class Scalar>
Eigen::JacobiSVD<MatrixX<Scalar>> singular(const MatrixX<Scalar>& A, unsigned vectors, Scalar threshold = 0) {
  Eigen::JacobiSVD<MatrixX<Scalar>> svd(A, vectors);
  svd.setThreshold(threshold);
  return svd;
}

}  // namespace

template <class Scalar>
VectorX<Scalar> solved_by_lu(const MatrixX<Scalar>& A, const VectorX<Scalar>& b) {
  return A.partialPivLu().solve(b);
}

template <class Scalar>
MatrixX<Scalar> solved_by_lu(const MatrixX<Scalar>& A, const MatrixX<Scalar>& B) {
  return A.partialPivLu().solve(B);
}

template <class Scalar>
MatrixX<Scalar> inverse(const MatrixX<Scalar>& A) {
  return A.partialPivLu().inverse();
}

template <class Scalar>
MatrixX<Scalar> pivoted_inverse(const MatrixX<Scalar>& A) {
  return Eigen::FullPivLU<MatrixX<Scalar>>(A).inverse();
}

template <class Scalar>
Scalar determinant(const MatrixX<Scalar>& A) {
  return A.rows() == 0 ? Scalar(1) : A.partialPivLu().determinant();
}

template <class Scalar>
VectorX<Scalar> solved_by_ldlt(const MatrixX<Scalar>& A, const VectorX<Scalar>& b) {
  return A.ldlt().solve(b);
}

template <class Scalar>
MatrixX<Scalar> solved_by_ldlt(const MatrixX<Scalar>& A, const MatrixX<Scalar>& B) {
  return A.ldlt().solve(B);
}

template <class Scalar>
PivotedSolution<Scalar> solved_by_full_lu(const MatrixX<Scalar>& A, const VectorX<Scalar>& b) {
  const Eigen::FullPivLU<MatrixX<Scalar>> factors(A);
  return {factors.solve(b), factors.rank(), factors.rcond()};
}

template <class Scalar>
VectorX<Scalar> least_squares(const MatrixX<Scalar>& A, const VectorX<Scalar>& b) {
  return A.colPivHouseholderQr().solve(b);
}

template <class Scalar>
VectorX<Scalar> least_norm(const MatrixX<Scalar>& A, const VectorX<Scalar>& b, Scalar threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixX<Scalar>> decomposition;
  decomposition.setThreshold(threshold);
  decomposition.compute(A);
  return decomposition.solve(b);
}

template <class Scalar>
std::vector<Eigen::Index> pivoted_columns(const MatrixX<Scalar>& A) {
  const auto order = A.colPivHouseholderQr().colsPermutation().indices();
  return {order.begin(), order.end()};
}

template <class Scalar>
MatrixX<Scalar> orthogonal_factor(const MatrixX<Scalar>& A) {
  return A.householderQr().householderQ() * MatrixX<Scalar>::Identity(A.rows(), A.rows());
}

template <class Scalar>
VectorX<Scalar> singular_values(const MatrixX<Scalar>& A) {
  return singular(A, 0).singularValues();
}

template <class Scalar>
MatrixX<Scalar> left_singular_vectors(const MatrixX<Scalar>& A) {
  return singular(A, Eigen::ComputeThinU).matrixU();
}

template <class Scalar>
MatrixX<Scalar> range(const MatrixX<Scalar>& A, Scalar threshold) {
  const auto svd = singular(A, Eigen::ComputeThinU, threshold);
  return svd.matrixU().leftCols(svd.rank());
}

template <class Scalar>
MatrixX<Scalar> null_space(const MatrixX<Scalar>& A, Scalar threshold) {
  const auto svd = singular(A, Eigen::ComputeFullV, threshold);
  return svd.matrixV().rightCols(A.cols() - svd.rank());
}

template <class Scalar>
Eigenpairs<Scalar> symmetric_eigenpairs(const MatrixX<Scalar>& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixX<Scalar>> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <class Scalar>
Scalar largest_eigenvalue(const MatrixX<Scalar>& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixX<Scalar>>(A, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

template <class Scalar>
MatrixX<Scalar> positive_inverse(const MatrixX<Scalar>& A) {
  const Eigen::LLT<MatrixX<Scalar>> factors(A);
  if (factors.info() != Eigen::Success) return {};
  return factors.solve(MatrixX<Scalar>::Identity(A.rows(), A.cols()));
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type takes none
#define JOURDAIN_INSTANTIATE(S)                                                        \
  template VectorX<S> solved_by_lu(const MatrixX<S>&, const VectorX<S>&);              \
  template MatrixX<S> inverse(const MatrixX<S>&);                                      \
  template S determinant(const MatrixX<S>&);                                           \
  template VectorX<S> solved_by_ldlt(const MatrixX<S>&, const VectorX<S>&);            \
  template PivotedSolution<S> solved_by_full_lu(const MatrixX<S>&, const VectorX<S>&); \
  template VectorX<S> least_squares(const MatrixX<S>&, const VectorX<S>&);             \
  template std::vector<Eigen::Index> pivoted_columns(const MatrixX<S>&);               \
  template MatrixX<S> orthogonal_factor(const MatrixX<S>&);                            \
  template VectorX<S> singular_values(const MatrixX<S>&);                              \
  template MatrixX<S> left_singular_vectors(const MatrixX<S>&);                        \
  template MatrixX<S> range(const MatrixX<S>&, S);                                     \
  template S largest_eigenvalue(const MatrixX<S>&);                                    \
  template MatrixX<S> positive_inverse(const MatrixX<S>&);
JOURDAIN_INSTANTIATE(JOURDAIN_SCALAR)
#undef JOURDAIN_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

// What one kind of number alone is asked for.
#ifdef JOURDAIN_LONG_DOUBLE
template MatrixX<long double> solved_by_ldlt(const MatrixX<long double>&, const MatrixX<long double>&);
template VectorX<long double> least_norm(const MatrixX<long double>&, const VectorX<long double>&,
                                         long double);
template MatrixX<long double> null_space(const MatrixX<long double>&, long double);
template Eigenpairs<long double> symmetric_eigenpairs(const MatrixX<long double>&);
#else
template MatrixX<double> solved_by_lu(const MatrixX<double>&, const MatrixX<double>&);
template MatrixX<double> pivoted_inverse(const MatrixX<double>&);
#endif

}  // namespace jourdain::reference
