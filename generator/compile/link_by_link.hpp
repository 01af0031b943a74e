// Choice of the derivation of M, k̄, q̄, inverse dynamics and kinetic energy, by counted operations.
#pragma once

#include "dynamics/equations.hpp"

namespace jourdain {

/// Of a tree; with loops other functions are made from these. Sets `k_bar_by_links` and `tau_by_links` where that takes
/// fewer operations, sines and cosines not counted, than by the composite bodies that the mass matrix needs anyway;
/// then, in small scenes that have equations of links, `from_links` where that costs less.
void choose_recursions(const model::Mechanism& mechanism, dynamics::DerivationOptions& derivation);

}  // namespace jourdain
