// Random mechanisms on which laws of all functions act.
#pragma once

#include <cstdint>

#include "model/mechanism.hpp"

namespace jourdain::tests {

/// Forces, loads, laws of springs and outputs by functions of every kind, states in half of the cases; where no loops
/// are closed, smooth terms of motions, and motions that states lead.
void add_laws(model::Mechanism& mechanism, std::uint64_t seed);

/// random_scene(seed) with forces, loads, laws of springs and outputs by functions of every kind, and with motions by
/// those that are smooth; half of them with states. Where a function has values on one side only, an `if` may hold it
/// back.
model::Mechanism random_scene_with_laws(std::uint64_t seed);

/// Of it with most of its laws as arguments of functions that the user defines, of one to three arguments.
model::Mechanism random_scene_with_calls(std::uint64_t seed);

}  // namespace jourdain::tests
