// Putting programs together: one program's values inside another.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "ir/builder.hpp"

namespace jourdain::ir {

/// What stands for a leaf; nothing: the leaf itself.
using LeafValue = std::function<std::optional<Signed>(LeafKind, std::size_t index)>;

/// Copies `program` into `builder`. Returns the values of its outputs, in order; outputs of the program are
/// not declared.
std::vector<Signed> insert(Builder& builder, const Program& program, const LeafValue& leaf);
std::vector<Signed> insert(Builder& builder, const Program& program);

}  // namespace jourdain::ir
