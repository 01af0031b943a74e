// What close_loops and project should make of an open state, by dense algebra in 77 digits.
#pragma once

#include "validate/loops/loop_oracle.hpp"

namespace jourdain::validate {

/// Their oracle at an open state.
std::vector<Expected> closing_expected(const LoopScene& scene, const ir::LeafValues<ScaledReal>& open,
                                       const ir::Program& program);

/// How far a state is open: the largest |g| of the rows that are solved for.
ScaledReal opening(const LoopScene& scene, const ir::LeafValues<ScaledReal>& state);

}  // namespace jourdain::validate
