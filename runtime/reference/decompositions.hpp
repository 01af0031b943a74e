// Decompositions of dense matrices as plain functions, compiled once for each kind of number: Eigen's
// templates for them take seconds wherever they are used.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace jourdain::reference {

template <class Scalar>
using VectorX = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using MatrixX = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// A⁻¹ b by LU with partial pivoting. For double and long double, as all of these.
template <class Scalar>
VectorX<Scalar> solved_by_lu(const MatrixX<Scalar>& A, const VectorX<Scalar>& b);
template <class Scalar>
MatrixX<Scalar> solved_by_lu(const MatrixX<Scalar>& A, const MatrixX<Scalar>& B);
template <class Scalar>
MatrixX<Scalar> inverse(const MatrixX<Scalar>& A);
/// By LU with full pivoting.
template <class Scalar>
MatrixX<Scalar> pivoted_inverse(const MatrixX<Scalar>& A);
/// 1 of an empty matrix.
template <class Scalar>
Scalar determinant(const MatrixX<Scalar>& A);

/// A⁻¹ b of a symmetric matrix by LDLᵀ.
template <class Scalar>
VectorX<Scalar> solved_by_ldlt(const MatrixX<Scalar>& A, const VectorX<Scalar>& b);
template <class Scalar>
MatrixX<Scalar> solved_by_ldlt(const MatrixX<Scalar>& A, const MatrixX<Scalar>& B);

/// What LU with full pivoting says.
template <class Scalar>
struct PivotedSolution {
  VectorX<Scalar> x;
  Eigen::Index rank = 0;
  Scalar reciprocal_condition = 0;  ///< of A, estimated in the 1-norm
};
template <class Scalar>
PivotedSolution<Scalar> solved_by_full_lu(const MatrixX<Scalar>& A, const VectorX<Scalar>& b);

/// The x that makes |A x − b| least, by QR with pivoting of columns.
template <class Scalar>
VectorX<Scalar> least_squares(const MatrixX<Scalar>& A, const VectorX<Scalar>& b);
/// Of those the shortest; pivots up to `threshold` of the largest count as zero.
template <class Scalar>
VectorX<Scalar> least_norm(const MatrixX<Scalar>& A, const VectorX<Scalar>& b, Scalar threshold);
/// The columns in the order in which pivoting takes them.
template <class Scalar>
std::vector<Eigen::Index> pivoted_columns(const MatrixX<Scalar>& A);
/// The orthogonal factor, square, of A = Q R without pivoting.
template <class Scalar>
MatrixX<Scalar> orthogonal_factor(const MatrixX<Scalar>& A);

/// Largest first.
template <class Scalar>
VectorX<Scalar> singular_values(const MatrixX<Scalar>& A);
/// Left singular vectors, those of larger values first, as many as A's smaller size.
template <class Scalar>
MatrixX<Scalar> left_singular_vectors(const MatrixX<Scalar>& A);
/// Left singular vectors of values above `threshold` of the largest.
template <class Scalar>
MatrixX<Scalar> range(const MatrixX<Scalar>& A, Scalar threshold);
/// Right singular vectors of the other values: orthonormal columns N with A N = 0.
template <class Scalar>
MatrixX<Scalar> null_space(const MatrixX<Scalar>& A, Scalar threshold);

/// Eigenvalues of a symmetric matrix, smallest first, and orthonormal eigenvectors as columns.
template <class Scalar>
struct Eigenpairs {
  VectorX<Scalar> values;
  MatrixX<Scalar> vectors;
};
template <class Scalar>
Eigenpairs<Scalar> symmetric_eigenpairs(const MatrixX<Scalar>& A);
template <class Scalar>
Scalar largest_eigenvalue(const MatrixX<Scalar>& A);
/// The inverse of a symmetric matrix by LLᵀ; empty where that finds A not positive definite.
template <class Scalar>
MatrixX<Scalar> positive_inverse(const MatrixX<Scalar>& A);

}  // namespace jourdain::reference
