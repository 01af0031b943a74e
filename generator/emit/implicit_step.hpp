// Linearly implicit steps as statements: Rosenbrock methods in the index-1 form (y, z, a = ż): one factorisation, and
// one residual per stage, no iteration.
#pragma once

#include "emit/rosenbrock.hpp"
#include "emit/step_functions.hpp"

namespace jourdain::emit {

/// Whether the residual changes over a step by itself: by time, or by the inputs.
bool residual_changes(const programs::SceneFacts& scene);

/// Adds what the steps share; the couplings are those of the program residual_derivatives.
void add_implicit_support(const programs::SceneFacts& scene, const ir::Program& derivatives,
                          Support& support);

Statements rosenbrock_step(const programs::SceneFacts& scene, const Rosenbrock& method);

}  // namespace jourdain::emit
