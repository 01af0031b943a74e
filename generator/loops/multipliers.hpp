// Multipliers in index-1 form: (G M⁻¹ Gᵀ) λ = G M⁻¹ (k̄ − q̄) + γ + 2 s ġ + s² g, with a bounded symmetric regularisation.
#pragma once

#include "loops/loop_system.hpp"

namespace jourdain::loops {

/// Factors of M and of S + Δ, S = G M⁻¹ Gᵀ, at one configuration. Δ is regularisation/row_length²; two corrections
/// λ ← λ + (S + Δ)⁻¹ (c − S λ) (proximal iterations) leave a share (δ/(σ + δ))³ of λ along a singular value σ of S: nothing where
/// the constraints are regular, all of it where they are not, so that redundant rows get the λ of least norm and singular
/// configurations a bounded one. S is banded where loops form a chain; it is factored in an order of least degree.
class MultiplierSolver {
 public:
  /// `M` full, by row.
  MultiplierSolver(ir::Builder& builder, const LoopSystem& system, const std::vector<Column>& M,
                   const ConstraintValues& constraints);

  /// L⁻ᵀ x for M = Lᵀ D L.
  Column lowered(const Column& x) const { return mass_.lowered(x); }
  /// λ with S λ = c.
  Column multipliers(const Column& c) const;
  /// G M⁻¹ x, with `lowered` = L⁻ᵀ x.
  Column constrained(const Column& lowered) const;
  /// M⁻¹ (x − Gᵀ λ), with `lowered` = L⁻ᵀ x.
  Column accelerations(const Column& lowered, const Column& lambda) const;

 private:
  void factorise_schur();
  Column schur_solved(Column c) const;

  ir::Builder& builder_;
  ir::SymmetricFactors mass_;
  std::vector<Column> V_;  ///< L⁻ᵀ Gᵀ, by row of G
  std::vector<std::size_t> order_;
  std::vector<Column> S_;  ///< factors of S + Δ in that order: unit lower triangle
  Column inverse_pivots_, delta_;
};

}  // namespace jourdain::loops
