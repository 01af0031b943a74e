// a b + a c → a (b + c): each factor that several terms of one sum share is multiplied once.
#pragma once

#include "ir/program.hpp"

namespace jourdain::passes {

/// Reassociating. Sums whose partial sums are used nowhere else are taken as a whole; of their terms, products that are
/// used nowhere else are grouped by the factor that most of them share. Never adds operations.
ir::Program factor(const ir::Program& program);

}  // namespace jourdain::passes
