// G, g_t, ġ and γ from the programs of constraint rows, by elimination on their graphs.
#pragma once

#include "ir/jacobian.hpp"
#include "ir/program.hpp"
#include "loops/rows/search_programs.hpp"
#include "model/coordinates.hpp"

namespace jourdain::loops {

/// What rows are made of; points that are looked for are held in all but `found`.
struct RowPrograms {
  ir::Program value;       ///< ("g", row), every row
  ir::Program velocities;  ///< ("v", row), of those that bind velocities alone
  ir::Program leading;     ///< ("rate", entry) of states that motions follow
  SearchPrograms searches;
};

/// ("G", row, velocity), ("g_t", row), as in ConstraintPrograms.
ir::Program differentiated_jacobian(const model::Tangent& tangent, const RowPrograms& rows,
                                    const ir::Surroundings& surroundings);

/// ("rate", row) and ("gamma", row), every row.
ir::Program differentiated_rates(const model::Tangent& tangent, const RowPrograms& rows,
                                 const ir::Surroundings& surroundings);

}  // namespace jourdain::loops
