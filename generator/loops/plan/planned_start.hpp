// Where a mechanism with loops that is planned starts at other values of its parameters.
#pragma once

#include <optional>

#include "loops/plan/start.hpp"
#include "loops/record/loop_plan.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// Where the mechanism starts at the values that its parameters have now, states left out: find_start_again, with
/// velocities that some motion has. Nothing after diagnostics.
std::optional<Start> planned_start(const model::Mechanism& mechanism, const LoopPlan& plan,
                                   support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
