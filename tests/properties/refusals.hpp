// Valid random mechanisms of every kind, and whether the compiler refuses one: a difference by rounding must
// not look like wrong algebra.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::tests {

struct ValidKind {
  std::string name;
  std::uint64_t bench = 0, test = 0;  ///< how many are tried
};

/// Trees, scenes with everything that a tree may have, loops, linkages, chains of up to 200 links, masses,
/// lengths, stiffnesses and speeds over 24 orders of magnitude.
const std::vector<ValidKind>& valid_kinds();

model::Mechanism valid_mechanism(const ValidKind& kind, std::uint64_t seed);

/// Why it was refused; empty where it was not. Asked for is everything that is not a step, of every eighth
/// small one derivatives too.
std::string refusal(const model::Mechanism& mechanism, std::uint64_t seed);

}  // namespace jourdain::tests
