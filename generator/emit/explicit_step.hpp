// Explicit methods as statements.
#pragma once

#include "emit/tree.hpp"
#include "programs/scene_facts.hpp"
#include "programs/steppers.hpp"

namespace jourdain::emit {

/// From the rates at `state` to its entries after the step `h`: nothing of the clock where states hold no time, nor of
/// what follows a step (unit quaternions, closed loops).
Statements explicit_step(const programs::Stepper& stepper, const programs::SceneFacts& scene);

}  // namespace jourdain::emit
