// Copying a program through a builder, the common part of the passes.
#pragma once

#include <vector>

#include "ir/builder.hpp"

namespace jourdain::passes {

/// Copy of `program` without values that no output needs; operations that became equal or trivial are merged.
/// This is the exact pass `remove_dead_code`.
ir::Program remove_dead_code(const ir::Program& program);

/// Marks the values that the outputs need.
std::vector<bool> needed_values(const ir::Program& program);

}  // namespace jourdain::passes
