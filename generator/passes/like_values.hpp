// Values of limbs that are alike: which can be computed at once, as lanes of one operation.
#pragma once

#include <optional>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::passes {

struct Leaf {
  ir::LeafKind kind = ir::LeafKind::kPosition;
  std::size_t index = 0;
};

/// Limbs of one shape: the leaves of each, in the same order.
using LikeLimbs = std::vector<std::vector<Leaf>>;

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

/// Of a program; values within a group have none of their own.
class Groups {
 public:
  explicit Groups(const ir::Program& program);

  const Group* at(ir::ValueId value) const { return groups_[value.value] ? &*groups_[value.value] : nullptr; }
  bool is_within(ir::ValueId value) const { return within_[value.value]; }
  /// Values whose groups have a term `value`, in their order.
  const std::vector<ir::ValueId>& users(ir::ValueId value) const { return users_[value.value]; }

 private:
  std::vector<std::optional<Group>> groups_;
  std::vector<bool> within_;
  std::vector<std::vector<ir::ValueId>> users_;
};

/// Groups of one shape, one for each lane. Lane 0 computes its value; another lane v or, `negative`, −v.
struct LikeGroups {
  struct Lane {
    ir::ValueId root;
    std::vector<Term> terms;  ///< in the order of those of lane 0, with the signs of this group
    bool negative = false;
  };
  std::vector<Lane> lanes;
};

/// In an order in which terms precede what is made of them, but where they come from groups that are not alike.
std::vector<LikeGroups> like_groups(const ir::Program& program, const Groups& groups,
                                    const std::vector<LikeLimbs>& limbs);

}  // namespace jourdain::passes
