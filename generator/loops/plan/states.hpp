// States beside a mechanism with loops: no loop holds them.
#pragma once

#include "loops/record/loop_plan.hpp"
#include "model/mechanism.hpp"

namespace jourdain::loops {

/// The mechanism with its states held where they start: they are no part of what loops hold together. Motions that
/// follow them go on as they start, and multipliers hold the loops.
model::Mechanism without_states(model::Mechanism mechanism);

/// States are independent and start as the description says.
void add_states(const model::Mechanism& mechanism, LoopPlan& plan);

}  // namespace jourdain::loops
