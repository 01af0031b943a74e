// Descriptions in TOML that differ from a valid one by what people and programs get wrong, and by what a reader may not
// expect.
#pragma once

#include <vector>

#include "fuzz/description_tree.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {

/// Changes `tree` once; tables may be taken from `donor`.
void mutate(Node& tree, Node& donor, Random& random);

}  // namespace jourdain::tests
