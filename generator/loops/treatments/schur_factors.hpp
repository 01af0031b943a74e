// Factors of a small symmetric positive semidefinite matrix that is regularised, as operations of a program.
#pragma once

#include <set>
#include <vector>

#include "ir/symmetric_factors.hpp"

namespace jourdain::loops {

using ir::Column;

/// Rows of which one counts; Δ over them is size / weight.
struct SharingRows {
  std::vector<std::size_t> rows;  ///< positions
  std::vector<double> weights;
  double size = 0;
};

/// S + Δ = L D Lᵀ for S = J W Jᵀ with positive definite W and a small positive diagonal Δ: no pivoting is
/// needed wherever the rows of J are independent, and none where they are not. Factored in an order of least
/// degree, since S is banded where loops form a chain.
///
/// Rows may share: where the others are eliminated what is left of S over them, R, has rank 1, whichever of
/// them are weak. Then R⁺ = W R W / tr(W R)², weights W, takes no choice among them, and what their numbers
/// disagree by is left open.
class SchurFactors {
 public:
  /// `S` full, by row.
  SchurFactors(ir::Builder& builder, std::vector<Column> S, Column delta, SharingRows sharing = {});

  /// (S + Δ)⁻¹ c.
  Column solved(Column c) const;
  /// That after corrections x ← x + (S + Δ)⁻¹ Δ x (proximal iterations): along a singular value σ of S a share
  /// (δ/(σ + δ))^(corrections + 1) of the solution is left out. Where S is singular the solution is bounded,
  /// of redundant rows the one of least norm.
  Column corrected(const Column& c, int corrections) const;
  /// det(S + Δ); of rows that share tr(W R) + δ.
  ir::Signed determinant() const;

 private:
  void eliminate(std::size_t pivot, std::vector<Column>& S);
  void invert_shared(const std::vector<Column>& S);
  Column shared(const Column& c) const;

  ir::Builder& builder_;
  std::vector<std::size_t> order_;  ///< rows that share come last
  std::size_t pivots_;              ///< the others
  std::vector<Column> L_;           ///< in that order: unit lower triangle
  Column inverse_pivots_, delta_;
  SharingRows sharing_;
  std::vector<Column> inverse_;  ///< over the rows that share
  ir::Signed trace_;             ///< of W R + Δ there
};

}  // namespace jourdain::loops
