// Rows that bind velocities alone.
#pragma once

#include <vector>

#include "loops/rows/configuration.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// False after a diagnostic: rates may not multiply each other, nor stand in functions.
bool check_linear(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                  support::Diagnostics& diagnostics);

/// Those of regular_rows. No row of velocities takes the place of one of positions, which would be left open.
std::vector<std::size_t> kept_rows(const NumericClosure& closure,
                                   const std::vector<Configuration>& configurations);

/// False after a diagnostic: Newton's iterations may not be asked for, and at each configuration those rows that
/// are not kept must follow from `kept`, what they ask of velocities too. They may do so at the start and not
/// elsewhere, or later, or but for the digits of the file. What touches the ground must be found at the start.
bool check_velocities(const model::Mechanism& mechanism, const NumericClosure& closure,
                      const std::vector<Configuration>& configurations, const std::vector<std::size_t>& kept,
                      support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
