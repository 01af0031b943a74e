// What the programs of a mechanism with loops are made of.
#pragma once

#include <functional>
#include <vector>

#include "ir/function_id.hpp"
#include "loops/record/loop_plan.hpp"
#include "loops/rows/constraints.hpp"
#include "loops/rows/dense_solver.hpp"
#include "model/coordinates.hpp"

namespace jourdain::loops {

/// Programs of the tree and of the constraints. Those of the tree are asked for by function; "outputs" and
/// "residual" take ż as leaves.
struct LoopSystem {
  const ConstraintPrograms& constraints;
  const LoopPlan& plan;
  const model::Mechanism& mechanism;
  model::CoordinateLayout layout;
  std::function<ir::Program(ir::FunctionId function)> tree;
};

/// Values of one program under construction, as far as all treatments share them: constraints at the leaves y, t.
class ConstraintValues {
 public:
  /// At the positions `y` (empty: the leaves).
  ConstraintValues(ir::Builder& builder, const LoopSystem& system, const Column& y = {});

  ir::Signed g(std::size_t row) const { return g_[row]; }
  /// G; zero where the program has no such entry.
  ir::Signed G(std::size_t row, std::size_t velocity) const { return G_[row][velocity]; }
  ir::Signed g_t(std::size_t row) const { return g_t_[row]; }

 private:
  Column g_, g_t_;
  std::vector<Column> G_;
};

/// ġ and γ of all rows with the velocities `z` of the tree.
struct ConstraintRates {
  Column rate, gamma;
};
ConstraintRates constraint_rates(ir::Builder& builder, const LoopSystem& system, const Column& z);

/// ẏ of the tree.
Column position_rates(ir::Builder& builder, const LoopSystem& system, const Column& z);

/// y of the tree moved by a small displacement; quaternions come back to unit length.
Column displaced(ir::Builder& builder, const model::Tangent& tangent, const Column& y,
                 const Column& displacement);

/// M of the tree, full, by row.
std::vector<Column> tree_mass_matrix(ir::Builder& builder, const LoopSystem& system);

/// The leaves y.
Column position_leaves(ir::Builder& builder, const LoopSystem& system);

}  // namespace jourdain::loops
