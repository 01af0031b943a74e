// Validation of what is emitted for a mechanism with loops, before it is written.
#pragma once

#include "dynamics/equations.hpp"
#include "ir/module.hpp"
#include "loops/closed_system.hpp"
#include "validate/translation.hpp"

namespace jourdain::loops {

/// The tree's equations against the numeric reference at random states; then, at closed configurations of seeded walks with random
/// velocities and inputs, the programs in double against M, k̄, q̄ and constraints of the symbolic equations in 60 digits (the
/// constraints differentiated by differences), put together by dense algebra in long double. Errors are relative to sums of
/// absolute terms times the condition number of what is solved.
validate::Verdict validate_closed(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                                  const ir::Module& module, const LoopPlan& plan);

}  // namespace jourdain::loops
