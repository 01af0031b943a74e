// How the numbers of outputs are called.
#pragma once

#include <string>
#include <vector>

#include "programs/scene_facts.hpp"

namespace jourdain::programs {

/// "[a][b]" with those of the two that the member's array has; a scalar has none.
std::string subscripts(const OutputMember& member, int a, int b);

/// Row by row: "tracer.position[0]", …
std::vector<std::string> number_names(const OutputFacts& output, const OutputMember& member);

}  // namespace jourdain::programs
