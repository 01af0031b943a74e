// Sines and cosines of sums of angles, without the sum.
#pragma once

#include "ir/program.hpp"

namespace jourdain::passes {

/// Reassociating. sin(a + b) becomes sin a cos b + cos a sin b, cos(a + b) alike: a sum of angles of many
/// turns is rounded with its size, and of what remains below one turn digits are lost that each of the angles
/// still has. Five operations more per angle; as many sines and cosines. Sums with a literal or a value that
/// depends on parameters alone stay.
ir::Program split_angles(const ir::Program& program);

}  // namespace jourdain::passes
