// Redundant rows as time goes on.
#pragma once

#include "loops/record/loop_plan.hpp"
#include "loops/rows/configuration.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// False after a diagnostic: where motions and lengths prescribe positions, rows that `plan` leaves out have to follow
/// from `plan.rows` later, too, or be left open by no more than LoopPlan::most_left_open. Looked for over a hundred
/// steps of time, seconds where motions are slow, while the others close.
bool check_later(const model::Mechanism& mechanism, NumericClosure closure, const Configuration& start,
                 const LoopPlan& plan, support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
