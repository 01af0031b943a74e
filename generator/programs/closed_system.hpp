// A mechanism with loops as the emitted functions need it: its tree's equations, its constraints, the plan.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "dynamics/equations.hpp"
#include "programs/loop_functions.hpp"

namespace jourdain::programs {

/// Owns what a LoopSystem refers to. It refers to the mechanism and the plan, which must outlive it.
class ClosedSystem {
 public:
  ClosedSystem(const model::Mechanism& mechanism, const dynamics::DerivationOptions& options,
               const loops::LoopPlan& plan);
  ClosedSystem(const ClosedSystem&) = delete;

  const dynamics::Equations& equations() const { return equations_; }  ///< of the tree, for derivatives
  const loops::ConstraintPrograms& constraints() const { return constraints_; }
  const loops::LoopSystem& system() const { return system_; }

 private:
  const ir::Program& tree(const std::string& function);
  void choose(const std::vector<loops::ConstraintPrograms>& list);

  dynamics::Equations equations_;
  loops::ConstraintPrograms constraints_;
  std::map<std::string, ir::Program> lowered_;
  loops::LoopSystem system_;
};

/// Small displacements of the independent coordinates: entries of y, and of the velocities of the plan.
model::Tangent independent_tangent(const loops::LoopPlan& plan, const model::Tangent& tree);

/// Entries of y that close_loops sets; none with multipliers.
std::vector<std::size_t> dependent_positions(const loops::LoopPlan& plan, const model::Tangent& tree);

}  // namespace jourdain::programs
