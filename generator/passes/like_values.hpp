// Values of limbs that are alike: which can be computed at once, as lanes of one operation.
#pragma once

#include <vector>

#include "ir/program.hpp"
#include "passes/groups.hpp"

namespace jourdain::passes {

struct Leaf {
  ir::LeafKind kind = ir::LeafKind::kPosition;
  std::size_t index = 0;
};

/// Limbs of one shape: the leaves of each, in the same order.
using LikeLimbs = std::vector<std::vector<Leaf>>;

/// Groups of one shape, one for each lane. Lane 0 computes its value; another lane v or, `negative`, −v.
struct LikeGroups {
  struct Lane {
    ir::ValueId root;
    std::vector<Term> terms;  ///< in the order of those of lane 0, with the signs of this group
    bool negative = false;
  };
  std::vector<Lane> lanes;
};

/// A sum that adds up values of limbs, which each limb can add up for itself.
struct SumOverLimbs {
  ir::ValueId root;
  /// Each a list of like groups, by number, all lanes of which are terms of the sum: with the same signs in each lane,
  /// or the opposite in all of it.
  std::vector<std::vector<std::size_t>> together;
};

struct LikeValues {
  /// In an order in which terms precede what is made of them, but where they come from groups that are not alike.
  std::vector<LikeGroups> groups;
  std::vector<SumOverLimbs> sums;
};

LikeValues like_values(const ir::Program& program, const Groups& groups, const std::vector<LikeLimbs>& limbs);

}  // namespace jourdain::passes
