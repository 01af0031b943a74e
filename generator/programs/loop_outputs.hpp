// The outputs of a mechanism with loops: those of its tree, in terms of the independent velocities.
#pragma once

#include "loops/treatments/dependence.hpp"

namespace jourdain::programs {

/// Do the tree's outputs depend on the loops' constraint forces?
bool takes_multipliers(const ir::Program& tree);

/// Declares the outputs of the program `tree`, whose values are given, in their order. Jacobians J of the tree
/// become J B, and v̄ + J b, ā + J β stand for their v̄, ā; ω̄ and ζ̄ alike.
void write_outputs(ir::Builder& builder, const loops::LoopSystem& system, const loops::Dependence& dependence,
                   const ir::Program& tree, const ir::Column& values);

/// Declares the values of the states that are sampled, which are the last of the independent velocities, or of all.
void write_samples(ir::Builder& builder, const loops::LoopSystem& system, const loops::Dependence& dependence,
                   const ir::Column& values);

}  // namespace jourdain::programs
