// In which order operations and groups that are computed at once come.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "passes/like_values.hpp"

namespace jourdain::passes {

/// A unit is an operation, by its value, or a bundle of like groups, by its number after all values.
struct LaneOrder {
  std::vector<LikeGroups> bundles;
  std::vector<std::optional<std::size_t>>
      unit;                        ///< of each value; none for leaves and within groups of bundles
  std::vector<std::size_t> units;  ///< each after what it needs, as early as it stands in the program
};

/// Bundles that wait for each other are given up, as few as it takes when one at a time is taken from each cycle.
LaneOrder order_in_lanes(const ir::Program& program, const Groups& groups, std::vector<LikeGroups> bundles);

}  // namespace jourdain::passes
