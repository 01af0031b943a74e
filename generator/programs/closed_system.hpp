// A mechanism with loops as the emitted functions need it: its tree's equations, its constraints, the plan.
#pragma once

#include <map>

#include "dynamics/equations.hpp"
#include "programs/loop_functions.hpp"
#include "programs/scene_programs.hpp"

namespace jourdain::programs {

/// Owns what a LoopSystem refers to. It refers to the mechanism and the plan, which must outlive it.
class ClosedSystem : public ScenePrograms {
 public:
  ClosedSystem(const model::Mechanism& mechanism, const dynamics::DerivationOptions& options,
               const loops::LoopPlan& plan);
  ClosedSystem(const ClosedSystem&) = delete;

  ir::Program program(ir::FunctionId function) const override;
  ir::Program kinematic_program(std::size_t k) const override;
  DerivativeSources derivative_sources() const override;

  const dynamics::Equations& equations() const { return equations_; }  ///< of the tree, for derivatives
  const loops::ConstraintPrograms& constraints() const { return constraints_; }
  const loops::LoopSystem& system() const { return system_; }

 private:
  const ir::Program& tree(ir::FunctionId function);
  void choose(const std::vector<loops::ConstraintPrograms>& list);

  dynamics::Equations equations_;
  loops::ConstraintPrograms constraints_;
  std::map<ir::FunctionId, ir::Program> lowered_;
  loops::LoopSystem system_;
};

}  // namespace jourdain::programs
