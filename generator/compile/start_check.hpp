// Whether a mechanism has equations of motion where it starts.
#pragma once

#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain {

/// Forces, springs, curves and outputs that have no finite value at the initial state, t = 0, with inputs zero, become
/// diagnostics, and so do joints that move no inertia there (M is singular); call it before `compile`.
void check_start(const model::Mechanism& mechanism, support::Diagnostics& diagnostics);

}  // namespace jourdain
