// Sums and products as a whole.
#pragma once

#include <optional>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::passes {

struct Term {
  ir::ValueId value;
  bool negative = false;
};

/// A sum of signed terms or a product of factors, with all sums or products that are used once and in it; otherwise
/// one operation and its operands.
struct Group {
  ir::Op op = ir::Op::kAdd;  ///< kAdd: a sum, kMultiply: a product
  std::vector<Term> terms;
};

/// Of a program; values within a group have none of their own. Those that stand `apart` have their own group always.
class Groups {
 public:
  explicit Groups(const ir::Program& program, const std::vector<bool>& apart = {});

  const Group* at(ir::ValueId value) const { return groups_[value.value] ? &*groups_[value.value] : nullptr; }
  bool is_within(ir::ValueId value) const { return within_[value.value]; }
  /// Values whose groups have a term `value`, in their order.
  const std::vector<ir::ValueId>& users(ir::ValueId value) const { return users_[value.value]; }

 private:
  std::vector<std::optional<Group>> groups_;
  std::vector<bool> within_;
  std::vector<std::vector<ir::ValueId>> users_;
};

}  // namespace jourdain::passes
