// Redundant rows as time goes on.
#pragma once

#include <vector>

#include "loops/rows/configuration.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// False after a diagnostic: where motions and lengths prescribe positions, rows that are not kept have to follow from
/// `kept` later, too, or be left open by no more than 2e-3 (m, rad) or ten times `left_open`. Looked for over a hundred
/// steps of time, seconds where motions are slow, while the others close.
bool check_later(const model::Mechanism& mechanism, NumericClosure closure, const Configuration& start,
                 const std::vector<std::size_t>& kept, double left_open, support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
