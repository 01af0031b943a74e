// Decides offline on a mechanism's loops.
#pragma once

#include <optional>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/constraints.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// Decides on the loops of `mechanism`. Nothing after diagnostics (loops that cannot be assembled, no freedom
/// left, a treatment that is asked for and not possible).
std::optional<LoopPlan> plan_loops(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                                   support::Diagnostics& diagnostics);

/// Plans the loops of `mechanism`, if it has any. Nothing otherwise, and after diagnostics.
std::optional<LoopPlan> plan_loops(const model::Mechanism& mechanism, support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
