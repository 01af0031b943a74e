// The constraints of the loops and their derivatives as programs.
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "ir/program.hpp"
#include "loops/rows/search_programs.hpp"
#include "model/mechanism.hpp"

namespace jourdain::loops {

/// g(y, t), its Jacobian G by the displacements of model::Tangent and g_t; ġ = G z + g_t and γ = g̈ − G ż.
/// Leaves are the y and z of the tree, t and parameters. Entries that are zero whatever the state are left out.
struct ConstraintPrograms {
  ir::Program value;   ///< ("g", row), every row
  ir::Program senses;  ///< ("sense", loop), as in dynamics::LoopClosure
  ir::Program
      spans;  ///< of rods: ("span", row, axis) from end to end, axes of the carrier's link, and ("length", row)
  ir::Program velocities;  ///< ("v", row), rows that bind velocities alone: their G z + g_t; their g is 0
  ir::Program misses;  ///< ("miss", loop, number), ("determinant", …), ("trace", …): of dynamics::Search
  SearchPrograms searches;
  ir::Program jacobian;  ///< ("G", row, velocity), ("g_t", row)
  ir::Program rates;     ///< ("rate", row) and ("gamma", row), every row
};

/// A loop does not feel how its carrier moves: the coordinates inward of it are taken as zero in its rows.
/// There are several ways to the derivatives: first those with the fewest operations each, then others that
/// may share more with what they are used in.
std::vector<ConstraintPrograms> constraint_programs(const model::Mechanism& mechanism,
                                                    const dynamics::Equations& equations);

/// Those with the fewest operations, of equations that are derived for them alone.
ConstraintPrograms closure_programs(const model::Mechanism& mechanism);

}  // namespace jourdain::loops
