// A scene's equations as programs before any pass: of a tree, or with its loops closed.
#pragma once

#include <vector>

#include "ir/module.hpp"
#include "programs/derivatives.hpp"
#include "programs/functions.hpp"

namespace jourdain::programs {

class ScenePrograms {
 public:
  virtual ~ScenePrograms() = default;

  /// Of a function that holds no derivatives.
  virtual ir::Program program(ir::FunctionId function) const = 0;
  /// Of the mechanism's k-th function of the kinematics.
  virtual ir::Program kinematic_program(std::size_t k) const = 0;
  /// What its derivatives are taken of.
  virtual DerivativeSources derivative_sources() const = 0;
};

/// The programs of `functions`; steps have none.
ir::Module lower_scene(const ScenePrograms& scene, const std::vector<FunctionInfo>& functions,
                       DerivativeTerms terms);

}  // namespace jourdain::programs
