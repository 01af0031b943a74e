// In which order the terms of a sum are added, and the factors of a product multiplied.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ir/builder.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::passes {

/// Pair by pair: a step joins what stands at two places; its result stands at the next place after the terms and the
/// results of earlier steps.
struct Association {
  std::vector<ir::Signed> terms;
  std::vector<std::array<std::size_t, 2>> steps;  ///< one fewer than terms; the last one gives the whole

  /// Appends a step; returns the place of its result.
  std::size_t join(std::size_t a, std::size_t b) {
    steps.push_back({a, b});
    return terms.size() + steps.size() - 1;
  }
};

/// What stands at each place in a copy of the program of the terms. `op` is kAdd or kMultiply.
std::vector<ir::Signed> places_in(Copy& copy, ir::Op op, const Association& association);

}  // namespace jourdain::passes
