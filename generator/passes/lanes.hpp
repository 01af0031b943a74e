// Limbs that are alike, computed at once.
#pragma once

#include <vector>

#include "ir/program.hpp"
#include "passes/like_values.hpp"

namespace jourdain::passes {

/// Operations that have to be saved, and their share of all: small programs are as fast one value after the other.
struct LeastGain {
  std::size_t operations = 100, percent = 10;
};

/// The same values, but where `limbs` are alike in one order and with one sign, next to each other and named in
/// `lanes`: terms of sums are added in another order, so that rounding differs, and the sign of zero. No more
/// operations, but more negations. The program itself where less than `least` would be saved.
ir::Program in_lanes(const ir::Program& program, const std::vector<LikeLimbs>& limbs,
                     const LeastGain& least = {});

/// Operations that are computed with others at once, but for the first of each.
std::size_t saved_by_lanes(const ir::Program& program);

}  // namespace jourdain::passes
