// Validation of what is emitted for a mechanism with loops, before it is written.
#pragma once

#include "dynamics/equations.hpp"
#include "ir/module.hpp"
#include "loops/record/loop_plan.hpp"
#include "validate/translation.hpp"

namespace jourdain::validate {

/// The tree's equations against the numeric reference at random states; then, at closed configurations of
/// seeded walks with random velocities and inputs, and at open ones beside two of them, the programs against
/// dense algebra on the equations and constraints of the tree (LoopOracle), in 77 digits. Loops are closed
/// from open states.
Verdict validate_closed(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                        const ir::Module& module, const loops::LoopPlan& plan);

}  // namespace jourdain::validate
