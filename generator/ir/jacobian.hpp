// Derivatives of a program by elimination on its computational graph, which keeps all that is sparse.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "ir/builder.hpp"
#include "ir/elimination_choice.hpp"

namespace jourdain::ir {

/// The dependence of a leaf, or of a value that is held, on one column of a Jacobian: ∂leaf/∂column. Without seeds it
/// is constant.
struct Seed {
  Signed leaf;
  std::size_t column = 0;
  Signed partial;
};

/// Entries that are not zero whatever the state, by row and column.
using JacobianEntries = std::map<std::pair<std::size_t, std::size_t>, Signed>;

/// ∂values/∂columns. Every value of the builder's program between leaf and result is a vertex whose edges carry local
/// partial derivatives; removing a vertex joins its operands to its users by the chain rule, until only columns and
/// rows are left (Griewank, Walther: Evaluating Derivatives, chapter 9). The result does not depend on the order in
/// which vertices leave, the operations do: it is looked for by trying (ir/elimination_search.hpp). New operations go
/// into `builder`. Values that are `held` are leaves here: they change as their seeds say, not as what they are
/// computed from.
JacobianEntries differentiate(Builder& builder, const std::vector<Signed>& values,
                              const std::vector<Seed>& seeds, const std::vector<Signed>& held = {},
                              const Surroundings& surroundings = {});

}  // namespace jourdain::ir
