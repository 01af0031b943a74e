// Velocities that no motion has.
#pragma once

#include <vector>

#include "loops/rows/configuration.hpp"
#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// Whether some motion starts there with the velocities `z`, of `rows` that are independent elsewhere; false after a
/// diagnostic. Where a mechanism is singular, as bars on one line, velocities that keep the loops closed may still bend
/// them open: then g̈ is not zero whatever the accelerations are.
bool check_bend(const model::Mechanism& mechanism, const NumericClosure& closure, const Configuration& start,
                const Vector& z, const std::vector<std::size_t>& rows, support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
