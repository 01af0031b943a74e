// Programs that hold derivatives, by the order of elimination that leaves the fewest operations.
#pragma once

#include <functional>

#include "ir/elimination_choice.hpp"

namespace jourdain::passes {

/// In an order that is looked for. Small programs are built in some simple orders, too, since the search counts what
/// the passes will do roughly, and so are those that take values by signs, for which nothing is looked for.
ir::Program cheapest(const std::function<ir::Program(const ir::Surroundings&)>& build);

}  // namespace jourdain::passes
