// In which order a block of a Jacobian may be eliminated.
#pragma once

#include <vector>

#include "loops/closed_form/position_blocks.hpp"
#include "loops/rows/configuration.hpp"

namespace jourdain::loops {

/// Rows and columns of the block in an order whose pivots are large at the first of the Jacobians, with few
/// operations; empty where one nearly vanishes at another: sampled, what is used needs a proof.
Elimination elimination_order(const std::vector<Matrix>& jacobians, const std::vector<std::size_t>& rows,
                              const std::vector<std::size_t>& columns);

}  // namespace jourdain::loops
