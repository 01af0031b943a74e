// Choice of the algorithm that solves M ż = k̄ − q̄, by counted operations.
#pragma once

#include <cstddef>
#include <vector>

#include "dynamics/equations.hpp"

namespace jourdain {

struct Articulation {
  std::vector<bool> links;     ///< DerivationOptions::articulated
  std::size_t operations = 0;  ///< of the accelerations before any pass, as chosen
  std::size_t factorised =
      0;  ///< without articulated bodies but a free root's; 0 for large scenes, where it is not
          ///< counted because it grows with the cube of a branch's length
  std::size_t articulated = 0;  ///< with all links articulated (the articulated-body algorithm)
};

/// Which links are articulated bodies (the others' joints are eliminated from M): first the best depth from the roots,
/// then branch by branch one link more or less as long as that saves operations. Large scenes start from all links.
Articulation choose_articulation(const model::Mechanism& mechanism,
                                 const dynamics::DerivationOptions& options);

}  // namespace jourdain
