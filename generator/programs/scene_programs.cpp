#include "programs/scene_programs.hpp"

#include <utility>

namespace jourdain::programs {

ir::Module lower_scene(const ScenePrograms& scene, const std::vector<FunctionInfo>& functions,
                       DerivativeTerms terms) {
  ir::Module lowered;
  for (const FunctionInfo& function : functions) {
    if (function.id && !function.holds_derivatives) lowered.functions.push_back(scene.program(*function.id));
    if (function.kinematic) lowered.functions.push_back(scene.kinematic_program(*function.kinematic));
  }
  if (!any_derivatives(functions)) return lowered;
  for (ir::Program& program : derivative_programs(scene.derivative_sources(), functions, terms))
    lowered.functions.push_back(std::move(program));
  return lowered;
}

}  // namespace jourdain::programs
