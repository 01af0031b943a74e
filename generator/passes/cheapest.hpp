// Programs that hold derivatives, by the order of elimination that leaves the fewest operations.
#pragma once

#include <functional>

#include "ir/elimination_choice.hpp"

namespace jourdain::passes {

/// In an order that is looked for; small programs also in some simple orders, since what is looked for counts what the
/// passes will do roughly.
ir::Program cheapest(const std::function<ir::Program(const ir::Surroundings&)>& build);

}  // namespace jourdain::passes
