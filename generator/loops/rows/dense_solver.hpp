// Small square systems as operations of a program, without pivoting and regular wherever the matrix is.
#pragma once

#include <vector>

#include "ir/symmetric_factors.hpp"

namespace jourdain::loops {

using ir::Column;

/// Solves A x = b and Aᵀ x = b: up to three unknowns by cofactors, more by orthogonalisation (modified
/// Gram-Schmidt). Elimination in a fixed order divides by pivots that may vanish where A is regular: it is for
/// matrices whose pivots are known not to.
class DenseSolver {
 public:
  static constexpr std::size_t kLargestByCofactors = 3;

  /// `A` by row. With `in_order` every leading block is regular wherever the program is used.
  DenseSolver(ir::Builder& builder, std::vector<Column> A, bool in_order = false);

  Column solve(Column b) const;
  Column solve_transposed(const Column& b) const;
  /// det A; beyond three unknowns its square. Not of elimination in order.
  ir::Signed determinant() const;
  const Column& pivots() const { return pivots_; }  ///< of elimination in order

 private:
  void eliminate();
  ir::Signed minor(std::size_t row, std::size_t column) const;
  void invert();
  void orthogonalise();
  ir::Signed product(const Column& a, const Column& b) const;
  void subtract(Column& a, ir::Signed factor, const Column& b) const;

  ir::Builder& builder_;
  std::vector<Column> A_;  ///< after elimination in order its factors, the lower one with unit diagonal
  bool in_order_;
  Column pivots_, inverse_pivots_;
  std::vector<Column> cofactors_;  ///< by row; up to three unknowns
  ir::Signed determinant_, inverse_determinant_;
  std::vector<Column> Q_, R_;  ///< orthogonal columns, not normalised; unit upper triangle by row
  Column inverse_squares_;     ///< of the columns of Q
};

}  // namespace jourdain::loops
