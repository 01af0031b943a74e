// Which rows the multipliers of redundant constraints are shared among.
#pragma once

#include <vector>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/configuration.hpp"

namespace jourdain::loops {

/// Redundant rows may be so in turn: of the two rows that hold an axis, fixed in a body that turns, now the
/// one follows from the others and now the other. Then no choice stays regular, though the mechanism does. Of
/// `rows`, which are regular, one that does not stay so and those that take its place, if there are any such; in order.
std::vector<std::size_t> sharing_rows(const std::vector<Matrix>& jacobians,
                                      const std::vector<std::size_t>& rows);

/// Regularisation of rows beside those that share, over that of others: R has rank 1 but for it.
inline constexpr double kBesideSharing = 1e-4;

}  // namespace jourdain::loops
