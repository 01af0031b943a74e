// Sums over limbs, added up limb by limb.
#pragma once

#include "passes/like_values.hpp"
#include "passes/term_order.hpp"

namespace jourdain::passes {

/// The same values with as many operations, but what a sum takes from one limb is added up first where that can be done
/// with the same operations in all limbs of a kind. Those sums of a limb stand apart.
Reordered limb_by_limb(const ir::Program& program, const std::vector<LikeLimbs>& limbs);

}  // namespace jourdain::passes
