// Text of linearly implicit steps: Rosenbrock methods in the index-1 form (y, z, a = ż) of the design, section 5. One
// factorisation and one residual per stage, no iteration.
#pragma once

#include <string>
#include <vector>

#include "emit/rosenbrock.hpp"
#include "emit/step_text.hpp"

namespace jourdain::emit {

/// What the steps share; the couplings are those of the program residual_derivatives. Empty where no step is
/// linearly implicit.
std::string implicit_support(const programs::SceneFacts& scene,
                             const std::vector<programs::FunctionInfo>& functions,
                             const ir::Program* derivatives);

/// The struct of what linearly implicit methods remember; empty where none is emitted.
std::string accelerations_struct(const programs::SceneFacts& scene,
                                 const std::vector<programs::FunctionInfo>& functions);

/// Calls of close_loops by one step beside one at its end, where positions depend on others.
long closings_of(const programs::SceneFacts& scene, const Rosenbrock& method);

std::string rosenbrock_body(const programs::SceneFacts& scene, const Rosenbrock& method);

/// Operations of one step beside the calls of residual and residual_derivatives.
long rosenbrock_operations(const programs::SceneFacts& scene, const Rosenbrock& method,
                           const ir::Program& derivatives);

}  // namespace jourdain::emit
