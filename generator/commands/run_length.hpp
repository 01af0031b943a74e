// How many steps a run makes.
#pragma once

#include <optional>

namespace jourdain::commands {

/// As --duration, s, and --step, s, ask: the nearest whole number, up to 1e9, with a note where they ask for no whole
/// number. None after a message where they ask for less than one step or for too many.
std::optional<long> steps_asked_for(double duration, double step);

}  // namespace jourdain::commands
