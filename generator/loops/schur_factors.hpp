// Factors of a small symmetric positive semidefinite matrix that is regularised, as operations of a program.
#pragma once

#include <set>
#include <vector>

#include "ir/symmetric_factors.hpp"

namespace jourdain::loops {

using ir::Column;

/// S + Δ = L D Lᵀ for S = J W Jᵀ with positive definite W and a small positive diagonal Δ: no pivoting is needed wherever the rows
/// of J are independent, and none where they are not. Factored in an order of least degree, since S is banded where loops form a
/// chain.
class SchurFactors {
 public:
  /// `S` full, by row.
  SchurFactors(ir::Builder& builder, std::vector<Column> S, Column delta);

  /// (S + Δ)⁻¹ c.
  Column solved(Column c) const;
  /// That after corrections x ← x + (S + Δ)⁻¹ Δ x (proximal iterations): along a singular value σ of S a share
  /// (δ/(σ + δ))^(corrections + 1) of the solution is left out. Where S is singular the solution is bounded, of redundant rows the one of
  /// least norm.
  Column corrected(const Column& c, int corrections) const;
  /// det(S + Δ).
  ir::Signed determinant() const;

 private:
  ir::Builder& builder_;
  std::vector<std::size_t> order_;
  std::vector<Column> L_;  ///< in that order: unit lower triangle
  Column inverse_pivots_, delta_;
};

}  // namespace jourdain::loops
