// States beside random mechanisms.
#pragma once

#include <cstdint>

#include "model/mechanism.hpp"

namespace jourdain::tests {

/// One to three states, some of them memories, whose rates or samples hang on time, coordinates, velocities, inputs,
/// frames and each other, a force on a coordinate by each, and an output of the first. None where only time moves the
/// mechanism.
void add_states(model::Mechanism& mechanism, std::uint64_t seed);

}  // namespace jourdain::tests
