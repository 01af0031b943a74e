// Choice of the algorithm that solves M ż = k̄ − q̄, by counted operations.
#pragma once

#include <cstddef>
#include <vector>

#include "dynamics/equations.hpp"

namespace jourdain {

struct Articulation {
  std::vector<bool> links;      ///< DerivationOptions::articulated
  std::size_t operations = 0;   ///< of the accelerations before any pass, as chosen
  std::size_t factorised = 0;   ///< without articulated bodies but a free root's
  std::size_t articulated = 0;  ///< with all links articulated (the articulated-body algorithm)
};

/// Which links are articulated bodies (the others' joints are eliminated from M): first the best depth from the roots,
/// then branch by branch one link more or less as long as that saves operations.
Articulation choose_articulation(const model::Mechanism& mechanism,
                                 const dynamics::DerivationOptions& options);

}  // namespace jourdain
