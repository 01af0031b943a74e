#include "loops/rows/dense_solver.hpp"

#include "support/check.hpp"

namespace jourdain::loops {

using ir::Signed;

DenseSolver::DenseSolver(ir::Builder& builder, std::vector<Column> A, bool in_order)
    : builder_(builder), A_(std::move(A)), in_order_(in_order) {
  if (in_order)
    eliminate();
  else if (A_.size() <= kLargestByCofactors)
    invert();
  else
    orthogonalise();
}

void DenseSolver::eliminate() {
  for (std::size_t k = 0; k < A_.size(); ++k) {
    pivots_.push_back(A_[k][k]);
    inverse_pivots_.push_back(builder_.divide(builder_.literal(1), A_[k][k]));
    for (std::size_t i = k + 1; i < A_.size(); ++i) {
      A_[i][k] = builder_.multiply(A_[i][k], inverse_pivots_[k]);
      for (std::size_t j = k + 1; j < A_.size(); ++j)
        A_[i][j] = builder_.subtract(A_[i][j], builder_.multiply(A_[i][k], A_[k][j]));
    }
  }
}

Signed DenseSolver::product(const Column& a, const Column& b) const {
  Signed sum = builder_.literal(0);
  for (std::size_t i = 0; i < a.size(); ++i) sum = builder_.add(sum, builder_.multiply(a[i], b[i]));
  return sum;
}

void DenseSolver::subtract(Column& a, Signed factor, const Column& b) const {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = builder_.subtract(a[i], builder_.multiply(factor, b[i]));
}

/// The determinant without a row and a column, with the sign that it has in the inverse.
Signed DenseSolver::minor(std::size_t row, std::size_t column) const {
  const std::size_t n = A_.size();
  if (n == 1) return builder_.literal(1);
  if (n == 2) {
    const Signed entry = A_[1 - row][1 - column];
    return row == column ? entry : -entry;
  }
  const std::size_t r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
  const Signed across = builder_.multiply(A_[r1][c2], A_[r2][c1]);
  return builder_.subtract(builder_.multiply(A_[r1][c1], A_[r2][c2]), across);
}

void DenseSolver::invert() {
  const std::size_t n = A_.size();
  cofactors_.assign(n, Column(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) cofactors_[i][j] = minor(i, j);
  determinant_ = product(A_[0], cofactors_[0]);
  inverse_determinant_ = builder_.divide(builder_.literal(1), determinant_);
}

void DenseSolver::orthogonalise() {
  const std::size_t n = A_.size();
  R_.assign(n, Column(n, builder_.literal(0)));
  for (std::size_t j = 0; j < n; ++j) {
    Column v;
    for (std::size_t i = 0; i < n; ++i) v.push_back(A_[i][j]);
    for (std::size_t i = 0; i < j; ++i) {
      R_[i][j] = builder_.multiply(product(Q_[i], v), inverse_squares_[i]);
      subtract(v, R_[i][j], Q_[i]);
    }
    const Signed square = product(v, v);
    inverse_squares_.push_back(builder_.divide(builder_.literal(1), square));
    Q_.push_back(std::move(v));
  }
}

Signed DenseSolver::determinant() const {
  JD_CHECK(!in_order_, "no determinant of {} unknowns in order", A_.size());
  if (A_.size() <= kLargestByCofactors) return determinant_;
  Signed inverse = builder_.literal(1);
  for (const Signed& square : inverse_squares_) inverse = builder_.multiply(inverse, square);
  return builder_.divide(builder_.literal(1), inverse);
}

Column DenseSolver::solve(Column b) const {
  const std::size_t n = A_.size();
  if (in_order_) {
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = k + 1; i < n; ++i)
        b[i] = builder_.subtract(b[i], builder_.multiply(A_[i][k], b[k]));
    for (std::size_t k = n; k-- > 0;) {
      for (std::size_t j = k + 1; j < n; ++j)
        b[k] = builder_.subtract(b[k], builder_.multiply(A_[k][j], b[j]));
      b[k] = builder_.multiply(b[k], inverse_pivots_[k]);
    }
    return b;
  }
  Column x(n);
  if (n <= kLargestByCofactors) {
    for (std::size_t j = 0; j < n; ++j) {
      Signed sum = builder_.literal(0);
      for (std::size_t i = 0; i < n; ++i) sum = builder_.add(sum, builder_.multiply(cofactors_[i][j], b[i]));
      x[j] = builder_.multiply(sum, inverse_determinant_);
    }
    return x;
  }
  for (std::size_t j = 0; j < n; ++j) {
    x[j] = builder_.multiply(product(Q_[j], b), inverse_squares_[j]);
    subtract(b, x[j], Q_[j]);
  }
  for (std::size_t j = n; j-- > 0;)
    for (std::size_t i = 0; i < j; ++i) x[i] = builder_.subtract(x[i], builder_.multiply(R_[i][j], x[j]));
  return x;
}

Column DenseSolver::solve_transposed(const Column& b) const {
  const std::size_t n = A_.size();
  if (in_order_) {
    Column w = b;
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t j = 0; j < k; ++j) w[k] = builder_.subtract(w[k], builder_.multiply(A_[j][k], w[j]));
      w[k] = builder_.multiply(w[k], inverse_pivots_[k]);
    }
    for (std::size_t k = n; k-- > 0;)
      for (std::size_t i = k + 1; i < n; ++i)
        w[k] = builder_.subtract(w[k], builder_.multiply(A_[i][k], w[i]));
    return w;
  }
  Column x(n, builder_.literal(0));
  if (n <= kLargestByCofactors) {
    for (std::size_t i = 0; i < n; ++i)
      x[i] = builder_.multiply(product(cofactors_[i], b), inverse_determinant_);
    return x;
  }
  Column w = b;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < j; ++i) w[j] = builder_.subtract(w[j], builder_.multiply(R_[i][j], w[i]));
  for (std::size_t j = 0; j < n; ++j) {
    const Signed share = builder_.multiply(w[j], inverse_squares_[j]);
    subtract(x, -share, Q_[j]);
  }
  return x;
}

}  // namespace jourdain::loops
