// Copying a program through a builder, the common part of the passes.
#pragma once

#include <functional>
#include <vector>

#include "ir/builder.hpp"

namespace jourdain::passes {

/// Copy of `program` without values that no output needs; operations that became equal or trivial are merged.
/// This is the exact pass `remove_dead_code`.
ir::Program remove_dead_code(const ir::Program& program);

/// Copy of `program` without values that no output needs, all others as they are.
ir::Program without_unused(const ir::Program& program);

/// Have the two the same values in the same order, and the same outputs? Names apart.
bool same_operations(const ir::Program& a, const ir::Program& b);

using Rewriting = std::function<ir::Program(const ir::Program&)>;

/// `rewrite` run on its own result until that changes nothing: what makes a pass idempotent.
ir::Program settled(const ir::Program& program, const Rewriting& rewrite);

/// Marks the values that the outputs need.
std::vector<bool> needed_values(const ir::Program& program);

}  // namespace jourdain::passes
