// Where a mechanism with loops that is planned starts at other values of its parameters.
#pragma once

#include <optional>

#include "loops/plan/start.hpp"
#include "loops/record/loop_plan.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// Where the mechanism starts at the values that its parameters have now, states left out, with the independent
/// coordinates of `plan`; from beside a dead point, from where the plan starts. Nothing after diagnostics.
std::optional<Start> planned_start(const model::Mechanism& mechanism, const LoopPlan& plan,
                                   support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
