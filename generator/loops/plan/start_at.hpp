// Where a mechanism with loops that is planned starts at other values of its parameters.
#pragma once

#include <optional>

#include "loops/plan/start.hpp"
#include "loops/record/loop_plan.hpp"
#include "loops/rows/constraints.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// The constraints of the mechanism alone.
ConstraintPrograms closure_programs(const model::Mechanism& mechanism);

/// Where the mechanism starts at the values that its parameters have now, states left out, with the independent
/// coordinates that it was planned with. Nothing after diagnostics.
std::optional<Start> start_of(const model::Mechanism& mechanism, const LoopPlan& plan,
                              support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
