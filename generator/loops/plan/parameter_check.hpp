// Do the loops close at other values of the parameters?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loops/record/loop_plan.hpp"

namespace jourdain::loops {

/// Repeats the proof of a plan's treatment at these values of the parameters, where it does not cover them:
/// parameters in their ranges are covered by the plan's own proof, where nothing is proven nothing is
/// repeated. Nothing where it holds; otherwise why not, a phrase that names the parameters.
std::optional<std::string> unproven_at(const model::Mechanism& mechanism, const LoopPlan& plan,
                                       const std::vector<double>& parameters);

}  // namespace jourdain::loops
