// Values that are equal, or one operation away from each other, although they are written differently.
#pragma once

#include "ir/program.hpp"

namespace jourdain::passes {

/// Reassociating. A value that is a number, another value times and plus numbers, or the sum, difference or product of
/// two other values is computed so where that saves operations: what it was computed from before may then be needed by
/// nothing. What is equal is what is equal for all values of the leaves, see ir/fingerprints.hpp. A way that loses
/// digits at a sample that the present one keeps is not taken, see passes/sampled_rounding.hpp. Operations on
/// parameters and literals alone do not count: they go to the model's constants.
ir::Program resubstitute(const ir::Program& program);

}  // namespace jourdain::passes
