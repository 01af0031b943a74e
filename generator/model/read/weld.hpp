// Fingers, antennas and frames that a description hangs on moving joints without a mass.
#pragma once

#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Locks each joint beyond which the mechanism has no mass, no inertia and no rotor, and where nothing else is
/// either: no frame, spring, force, input, motion, loop or output, no start off zero. Joints of
/// which one follows the other are locked together. Such a joint has no equation of motion. `mechanism.welded` names
/// them and one warning does; nothing is done where no joint would be left. The joints make a tree.
void weld_massless_ends(Mechanism& mechanism, support::Diagnostics& diagnostics);

}  // namespace jourdain::model
