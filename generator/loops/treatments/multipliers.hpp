// Multipliers in index-1 form: (G M⁻¹ Gᵀ) λ = G M⁻¹ (k̄ − q̄) + γ + 2 s ġ + s² g, with a bounded symmetric
// regularisation.
#pragma once

#include "loops/rows/loop_system.hpp"
#include "loops/treatments/schur_factors.hpp"

namespace jourdain::loops {

/// Added to the diagonal of S over the square of each row's length, 1/kg, and corrections that make it good
/// (see SchurFactors).
struct Regularisation {
  double size = 0;
  int corrections = 1;
};

/// Factors of M and of S + Δ, S = G M⁻¹ Gᵀ, at one configuration, over some of the rows.
class MultiplierSolver {
 public:
  /// `M` full, by row.
  MultiplierSolver(ir::Builder& builder, const LoopSystem& system, const std::vector<Column>& M,
                   const ConstraintValues& constraints, const std::vector<std::size_t>& rows,
                   const Regularisation& regularisation);

  /// L⁻ᵀ x for M = Lᵀ D L.
  Column lowered(const Column& x) const { return mass_.lowered(x); }
  /// λ of the rows with S λ = c.
  Column multipliers(const Column& c) const { return schur_.corrected(c, corrections_); }
  /// That to first order in Δ, for a c that is nearly zero.
  Column corrections(const Column& c) const { return schur_.solved(c); }
  /// det(S + Δ).
  ir::Signed determinant() const { return schur_.determinant(); }
  /// G M⁻¹ x, with `lowered` = L⁻ᵀ x.
  Column constrained(const Column& lowered) const;
  /// M⁻¹ (x − Gᵀ λ), with `lowered` = L⁻ᵀ x.
  Column accelerations(const Column& lowered, const Column& lambda) const;

 private:
  std::vector<Column> lowered_rows(const ConstraintValues& constraints,
                                   const std::vector<std::size_t>& rows) const;
  std::vector<Column> products() const;

  ir::Builder& builder_;
  int corrections_;
  ir::SymmetricFactors mass_;
  std::vector<Column> V_;  ///< L⁻ᵀ Gᵀ, by row of G
  SchurFactors schur_;
};

}  // namespace jourdain::loops
