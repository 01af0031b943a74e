// How positions that are not closed may be displaced.
#pragma once

#include "model/coordinates.hpp"
#include "programs/scene_facts.hpp"

namespace jourdain::programs {

/// SceneFacts::tangent, and what is carried along: displaced by directions of its own, beyond those of z.
model::Tangent displaced_tangent(const SceneFacts& scene);

}  // namespace jourdain::programs
