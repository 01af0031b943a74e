// Velocities of the tree as functions of the independent ones: z = B z_i + b, ż = B ż_i + β.
#pragma once

#include "loops/rows/loop_system.hpp"

namespace jourdain::loops {

/// Values of one program; the plan must be reduced, or all velocities are independent: then B = 1, b = β = 0.
class Dependence {
 public:
  Dependence(ir::Builder& builder, const LoopSystem& system);

  std::size_t independent_count() const { return independent_.size(); }
  /// Column of B by independent velocity; entries by velocity of the tree.
  const std::vector<Column>& B() const { return B_; }
  const Column& z() const { return z_; }  ///< of the tree, from the leaves z
  const Column& b() const { return b_; }  ///< part of z that is driven

  /// How the tree is displaced as rows of positions stay closed: columns by displacement, of the independent
  /// coordinates, then of those carried along (LoopPlan::carried); entries by velocity of the tree. B where nothing is
  /// carried.
  std::vector<Column> displacements() const;
  /// What time adds to that, per second.
  Column drift() const;

  const Column& beta() const { return beta_; }  ///< bias of the accelerations

  /// B zdot + β.
  Column accelerations(const Column& zdot) const;
  /// Bᵀ rows.
  Column projected(const Column& rows) const;
  /// Multipliers of the rows used, G_dᵀ λ = forces on the dependent velocities; zero for the redundant rows.
  Column multipliers(Column forces) const;

 private:
  Column dependents(const Column& rows, const Column& known, bool positions_alone = false) const;

  ir::Builder& builder_;
  const LoopSystem& system_;
  std::vector<std::size_t> independent_;
  ConstraintValues values_;
  std::vector<DenseSolver> solvers_;  ///< by block
  std::vector<Column> B_;
  Column z_, b_, beta_;
};

}  // namespace jourdain::loops
