// Gimbals of every sequence, and what they are equal to.
#pragma once

#include <array>
#include <vector>

#include "model/mechanism.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {

/// Axes 0, 1, 2 of three turns, each about another one than the last.
using Sequence = std::array<std::size_t, 3>;
std::vector<Sequence> all_sequences();
Sequence random_sequence(Random& random);

/// The same mechanism, whose only joint is a gimbal, on three hinges with bodies of no mass between them.
model::Mechanism on_hinges(const model::Mechanism& gimbal);

/// The same mechanism, whose only joint is a gimbal, on a spherical joint.
model::Mechanism on_ball(model::Mechanism gimbal);

}  // namespace jourdain::tests
