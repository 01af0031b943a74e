// Equations of motion with multipliers: M ż + Gᵀ λ = k̄ − q̄ and G ż + γ + 2 s ġ + s² g = 0.
#pragma once

#include <vector>

#include "loops/rows/loop_system.hpp"
#include "loops/treatments/multipliers.hpp"
#include "programs/derivatives.hpp"

namespace jourdain::programs {

/// Values of one program; all velocities of the tree are independent, and some of the constraints' rows have
/// multipliers.
class ConstrainedEquations {
 public:
  ConstrainedEquations(ir::Builder& builder, const loops::LoopSystem& system, std::vector<std::size_t> rows);

  struct Motion {
    ir::Column zdot, lambda;
  };
  Motion motion() const;
  /// M ż + Gᵀ λ = −r, G ż = −c.
  Motion solved(ir::Column r, const ir::Column& c) const;

  /// M ż − k̄ + q̄ + Gᵀ λ
  ir::Column residual(const ir::Column& zdot, const ir::Column& lambda) const;
  /// G ż + γ + 2 s ġ + s² g
  ir::Column acceleration_rows(const ir::Column& zdot) const;

 private:
  ir::Builder& builder_;
  const loops::LoopSystem& system_;
  std::vector<std::size_t> rows_;
  loops::ConstraintValues constraints_;
  loops::MultiplierSolver solver_;
  loops::ConstraintRates rates_;
};

/// Those of the rows that are solved for, to be differentiated.
ConstrainedMotion constrained_motion(const loops::LoopSystem& system);

}  // namespace jourdain::programs
