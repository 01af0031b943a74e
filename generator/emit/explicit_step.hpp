// Explicit methods as statements.
#pragma once

#include "emit/tree.hpp"
#include "programs/steppers.hpp"

namespace jourdain::emit {

/// From the rates at `state` to its entries after the step `h`: nothing of the clock where states hold no time
/// (`clock`), nor of what follows a step (unit quaternions, closed loops).
Statements explicit_step(const programs::Stepper& stepper, bool clock);

}  // namespace jourdain::emit
