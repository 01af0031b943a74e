// The equations of a tree as one program per emitted function, before any pass.
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "ir/module.hpp"
#include "programs/scene_programs.hpp"

namespace jourdain::programs {

/// The program of an emitted function that holds no derivatives, or of the residual M ż − k̄ + q̄.
ir::Program lower_function(const dynamics::Equations& equations, ir::FunctionId function);

/// Those of `functions` that hold no derivatives.
ir::Module lower_functions(const dynamics::Equations& equations, const std::vector<FunctionInfo>& functions);

/// Refers to all of its arguments.
class TreePrograms : public ScenePrograms {
 public:
  TreePrograms(const model::Mechanism& mechanism, const dynamics::Equations& equations,
               const dynamics::DerivationOptions& options)
      : mechanism_(mechanism), equations_(equations), options_(options) {}

  ir::Program program(ir::FunctionId function) const override;
  ir::Program kinematic_program(std::size_t k) const override;
  DerivativeSources derivative_sources() const override;

 private:
  const model::Mechanism& mechanism_;
  const dynamics::Equations& equations_;
  const dynamics::DerivationOptions& options_;  ///< as asked for; derivatives choose their own
};

}  // namespace jourdain::programs
