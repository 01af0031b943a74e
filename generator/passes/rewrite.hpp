// Copying a program through a builder, the common part of the passes.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "ir/builder.hpp"

namespace jourdain::passes {

/// Copy of `program` without values that no output needs; operations that became equal or trivial are merged.
/// This is the exact pass `remove_dead_code`.
ir::Program remove_dead_code(const ir::Program& program);

/// Copy of `program` without values that no output needs, all others as they are.
ir::Program without_unused(const ir::Program& program);

/// These values of `program`, each after what it needs, and its outputs; without lanes.
ir::Program in_order(const ir::Program& program, const std::vector<ir::ValueId>& order);

/// Have the two the same values in the same order, and the same outputs? Names apart.
bool same_operations(const ir::Program& a, const ir::Program& b);

/// A copy of a program under construction.
class Copy {
 public:
  explicit Copy(const ir::Program& program)
      : program_(program), builder_(program.nodes.size()), values_(program.nodes.size()) {}

  /// What stands for a value of the program; nothing: the same operation on the copies of its operands.
  using Rewritten = std::function<std::optional<ir::Signed>(ir::ValueId)>;

  /// Values in their order, with their labels; then the outputs. Values that `left_out` has are not copied.
  ir::Program run(const Rewritten& rewritten, const std::vector<bool>& left_out = {});

  const ir::Signed& operator[](ir::ValueId id) const { return values_[id.value]; }
  ir::Builder& builder() { return builder_; }

 private:
  const ir::Program& program_;
  ir::Builder builder_;
  std::vector<ir::Signed> values_;
};

using Rewriting = std::function<ir::Program(const ir::Program&)>;

/// `rewrite` run on its own result until that changes nothing, or gives the program before, which is kept then: what
/// makes a pass idempotent.
ir::Program settled(const ir::Program& program, const Rewriting& rewrite);

/// Marks the values that the outputs need.
std::vector<bool> needed_values(const ir::Program& program);

}  // namespace jourdain::passes
