// In which order the terms of a sum are added, and the factors of a product multiplied.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ir/builder.hpp"

namespace jourdain::passes {

/// Pair by pair: a step joins what stands at two places; its result stands at the next place after the terms and the
/// results of earlier steps.
struct Association {
  std::vector<ir::Signed> terms;
  std::vector<std::array<std::size_t, 2>> steps;  ///< one fewer than terms; the last one gives the whole
};

}  // namespace jourdain::passes
