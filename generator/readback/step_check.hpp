// Steps of the text against their methods' definitions.
#pragma once

#include "readback/expected.hpp"
#include "readback/findings.hpp"
#include "readback/syntax.hpp"

namespace jourdain::readback {

/// Every step is executed at several random points, for held inputs and for sampled ones, with fresh and full
/// histories, with functions of which nothing is known in place of the model's. State, histories and the
/// arguments of all calls must agree with the definition in 70 digits: checked by identity testing, not proven.
void check_steps(const Unit& unit, const Expected& expected, Findings& findings);

}  // namespace jourdain::readback
