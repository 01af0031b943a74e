// Redundant rows that do not quite agree with the others.
#pragma once

#include <vector>

#include "loops/rows/configuration.hpp"
#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

struct Disagreement {
  std::vector<std::size_t> rows;
  double amount = 0;  ///< m, rad: the most by which they are open at the configurations seen
};

/// Numbers of a file have so and so many digits, and axes may be askew: rows that follow from others but for
/// that are left open by `closure` from here on, which is said. Nothing where all agree, or where they
/// disagree by more than 2e-3.
Disagreement settle_disagreement(const model::Mechanism& mechanism, NumericClosure& closure,
                                 const std::vector<std::size_t>& independent, std::size_t configurations,
                                 support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
