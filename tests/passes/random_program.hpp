// Seeded random straight-line programs.
#pragma once

#include <cstdint>

#include "ir/program.hpp"

namespace jourdain::tests {

/// Sums, differences, products and some sines of parameters, positions and literals; three outputs. No
/// divisions, so that every value is finite.
ir::Program random_program(std::uint64_t seed);

/// Values for its leaves, of size 1.
ir::LeafValues<double> random_leaves(std::uint64_t seed);

}  // namespace jourdain::tests
