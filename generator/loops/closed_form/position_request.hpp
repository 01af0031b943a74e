// What the closed form of a mechanism's dependent positions is asked for with.
#pragma once

#include <string>
#include <variant>

#include "loops/closed_form/position_blocks.hpp"
#include "loops/record/loop_plan.hpp"
#include "loops/rows/constraints.hpp"

namespace jourdain::loops {

/// Of the blocks of a plan, from its initial state. Parameters vary over their ranges, the others have their
/// default values. Otherwise why there is no closed form, a phrase.
std::variant<ClosedFormRequest, std::string> position_request(const model::Mechanism& mechanism,
                                                              const ConstraintPrograms& constraints,
                                                              const LoopPlan& plan);

/// By entry of y: the declared ranges.
std::vector<std::optional<std::array<double, 2>>> position_ranges(const model::Mechanism& mechanism);

}  // namespace jourdain::loops
