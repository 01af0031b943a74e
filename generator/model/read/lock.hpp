// A joint that does not move.
#pragma once

#include "model/mechanism.hpp"

namespace jourdain::model {

/// Makes the joint a fixed one, at coordinate zero. What acts on it goes with it; where an expression names
/// its coordinates, their rates or its actuators' inputs, zeros take their place. A residual of nothing else goes.
void lock(Mechanism& mechanism, JointIndex joint);

}  // namespace jourdain::model
