// Points of constraints that are looked for, and how they change.
#pragma once

#include <vector>

#include "ir/jacobian.hpp"
#include "ir/program.hpp"

namespace jourdain::loops {

/// Of all dynamics::Search of a scene, two numbers each.
struct SearchPrograms {
  ir::Program found;  ///< ("found", k)
  ir::Program
      misfits;  ///< ("misfit", k) and ("inverse", k, 0 or 1), of which ir::LeafKind::kHeld k is the number found

  bool is_empty() const { return found.outputs.empty(); }
};

/// How the numbers `found` change with the columns of `seeds`, as their misfits stay at zero: by number and column.
ir::JacobianEntries changes_of_found(ir::Builder& builder, const SearchPrograms& searches,
                                     const std::vector<ir::Signed>& found, const std::vector<ir::Seed>& seeds,
                                     const ir::Surroundings& surroundings);

}  // namespace jourdain::loops
