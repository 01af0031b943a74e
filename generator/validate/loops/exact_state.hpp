// States of a mechanism with loops in 77 digits: closing them, moving along them.
#pragma once

#include <vector>

#include "dynamics/closure_motion.hpp"
#include "loops/record/loop_plan.hpp"
#include "model/coordinates.hpp"
#include "validate/programs.hpp"

namespace jourdain::validate {

using support::ScaledReal;

/// The constraints of a mechanism, from their symbolic statements. It refers to what it is made from. Points that are
/// looked for are those of a state's LeafKind::kHeld where it has them.
class ExactClosure {
 public:
  ExactClosure(const model::Mechanism& mechanism, const dynamics::Equations& closures,
               const loops::LoopPlan& plan);

  const model::Tangent& tangent() const { return tangent_; }
  std::size_t velocity_count() const { return velocities_; }
  /// Velocities that depend on others.
  const std::vector<std::size_t>& dependents() const { return dependents_; }
  /// Of those: whose positions close rows, and whose positions move freely.
  const std::vector<std::size_t>& closed_velocities() const { return closed_; }
  const std::vector<std::size_t>& carried() const { return carried_; }

  /// g, G and g_t
  dynamics::ClosureJacobian jacobian(const ir::LeafValues<ScaledReal>& state) const;
  /// g and its rates at a state of the tree with all velocities `z`.
  dynamics::ClosureMotion motion(const ir::LeafValues<ScaledReal>& state,
                                 const std::vector<ScaledReal>& z) const;
  ExactVector g(const ir::LeafValues<ScaledReal>& state) const;
  /// Square of what points that are looked for may be missed by.
  ScaledReal missed(const ir::LeafValues<ScaledReal>& state) const;

  /// `moved` with the points found at `state`, as they move along.
  ir::LeafValues<ScaledReal> holding(const ir::LeafValues<ScaledReal>& state,
                                     ir::LeafValues<ScaledReal> moved) const;

  /// The positions moved by a displacement of all velocities: q ⊗ (1, d/2), brought to unit length.
  std::vector<ScaledReal> displaced(std::vector<ScaledReal> y, const ExactVector& displacement) const;

  /// The state with dependent positions that close the rows of positions, by Newton's method from where they are.
  ir::LeafValues<ScaledReal> closed(ir::LeafValues<ScaledReal> state) const;

 private:
  const dynamics::Equations& closures_;
  model::Tangent tangent_;
  std::size_t velocities_;
  std::vector<std::size_t> dependents_, closed_, carried_;
  std::vector<std::size_t> closing_rows_;
};

}  // namespace jourdain::validate
