// Names of the text that is read: each must be declared where it is used, also in code that a model never executes.
#pragma once

#include "readback/findings.hpp"
#include "readback/syntax.hpp"

namespace jourdain::readback {

/// Variables, constants, members and functions; members of objects are looked at where they are executed.
void check_scopes(const Unit& unit, Findings& findings);

}  // namespace jourdain::readback
