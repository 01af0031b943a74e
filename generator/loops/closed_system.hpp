// A mechanism with loops as the emitted functions need it: its tree's equations, its constraints, the plan.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "dynamics/equations.hpp"
#include "loops/programs.hpp"

namespace jourdain::loops {

/// Owns what a LoopSystem refers to. It refers to the mechanism and the plan, which must outlive it.
class ClosedSystem {
 public:
  ClosedSystem(const model::Mechanism& mechanism, const dynamics::DerivationOptions& options,
               const LoopPlan& plan);
  ClosedSystem(const ClosedSystem&) = delete;

  const dynamics::Equations& equations() const { return equations_; }  ///< of the tree, for derivatives
  const ConstraintPrograms& constraints() const { return constraints_; }
  const LoopSystem& system() const { return system_; }

 private:
  const ir::Program& tree(const std::string& function);
  void choose(const std::vector<ConstraintPrograms>& list);

  dynamics::Equations equations_;
  ConstraintPrograms constraints_;
  std::map<std::string, ir::Program> lowered_;
  LoopSystem system_;
};

/// Small displacements of the independent coordinates: entries of y, and of the velocities of the plan.
model::Tangent independent_tangent(const LoopPlan& plan, const model::Tangent& tree);

/// Entries of y that close_loops sets; none with multipliers.
std::vector<std::size_t> dependent_positions(const LoopPlan& plan, const model::Tangent& tree);

/// How the loops are closed, in sentences for the emitted header.
std::vector<std::string> sentences(const model::Mechanism& mechanism, const LoopPlan& plan);

/// What brings a step's end back to the closed loops: "2 Newton iterations".
std::string closing_text(const LoopPlan& plan);

/// What the assembly moved, for a person; empty where nothing moved.
std::string assembly_text(const LoopPlan& plan);

/// Plans the loops of `mechanism`, if it has any. Nothing otherwise, and after diagnostics.
std::optional<LoopPlan> plan_loops(const model::Mechanism& mechanism, support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
