// a b + a c → a (b + c): each factor that several terms of one sum share is multiplied once.
#pragma once

#include "ir/program.hpp"

namespace jourdain::passes {

/// Reassociating. Sums whose partial sums are used nowhere else are taken as a whole; of their terms, products that are
/// used nowhere else are grouped by the factor that most of them share, again and again for as long as that saves
/// operations. Never adds operations, and is idempotent: what one run leaves, another cannot improve.
ir::Program factor(const ir::Program& program);

}  // namespace jourdain::passes
