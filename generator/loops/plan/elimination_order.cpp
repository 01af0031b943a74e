#include "loops/plan/elimination_order.hpp"

#include <cmath>

#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

using support::at;

/// Of the largest entry left, rows and columns scaled: smaller ones are no pivots at the start, …
constexpr long double kLarge = 0.7L;
/// … and nowhere else.
constexpr long double kLeast = 1e-2L;

Matrix scaled(Matrix A) {
  for (Eigen::Index j = 0; j < A.cols(); ++j) A.col(j) /= A.col(j).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < A.rows(); ++i) A.row(i) /= A.row(i).cwiseAbs().maxCoeff();
  return A;
}

void eliminate(Matrix& A, Eigen::Index k) {
  for (Eigen::Index i = k + 1; i < A.rows(); ++i)
    A.row(i).tail(A.cols() - k) -= A(i, k) / A(k, k) * A.row(k).tail(A.cols() - k);
}

/// Brings the pivot of step k to its place: of the large entries the one with the fewest others beside it (Markowitz).
void choose_pivot(Matrix& A, Eigen::Index k, Elimination& order) {
  const auto rest = A.bottomRightCorner(A.rows() - k, A.cols() - k);
  const long double largest = rest.cwiseAbs().maxCoeff();
  Eigen::Index best = -1, row = 0, column = 0;
  for (Eigen::Index i = 0; i < rest.rows(); ++i)
    for (Eigen::Index j = 0; j < rest.cols(); ++j) {
      if (!(std::abs(rest(i, j)) >= kLarge * largest)) continue;
      const Eigen::Index work =
          ((rest.row(i).array() != 0).count() - 1) * ((rest.col(j).array() != 0).count() - 1);
      if (best < 0 || work < best) best = work, row = i, column = j;
    }
  A.row(k).swap(A.row(k + row));
  A.col(k).swap(A.col(k + column));
  const auto first = static_cast<std::size_t>(k);
  std::swap(order.rows[first], order.rows[first + static_cast<std::size_t>(row)]);
  std::swap(order.columns[first], order.columns[first + static_cast<std::size_t>(column)]);
}

bool has_pivots(const Matrix& G, const Elimination& order) {
  Matrix A = scaled(G(order.rows, order.columns));
  for (Eigen::Index k = 0; k < A.rows(); ++k) {
    if (!(std::abs(A(k, k)) > kLeast)) return false;
    eliminate(A, k);
  }
  return true;
}

}  // namespace

Elimination elimination_order(const std::vector<Matrix>& jacobians, const std::vector<std::size_t>& rows,
                              const std::vector<std::size_t>& columns) {
  Elimination order{rows, columns};
  Matrix A = scaled(jacobians.front()(rows, columns));
  for (Eigen::Index k = 0; k < at(rows.size()); ++k) {
    choose_pivot(A, k, order);
    eliminate(A, k);
  }
  for (const Matrix& G : jacobians)
    if (!has_pivots(G, order)) return {};
  return order;
}

}  // namespace jourdain::loops
