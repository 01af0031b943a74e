// Programs in 60 digits: whether two of them are the same function is seen in numbers, with forty digits to spare.
#pragma once

#include <cln/real.h>

#include <optional>
#include <vector>

#include "ir/module.hpp"

namespace jourdain::tests {

using Exact = cln::cl_R;

ir::LeafValues<Exact> to_exact(const ir::LeafValues<double>& leaves);

/// All values of a program, in order; none where it divides by zero or takes the root of a negative number.
std::optional<std::vector<Exact>> exact_nodes(const ir::Program& program,
                                              const ir::LeafValues<Exact>& leaves);

/// Those of its outputs.
std::vector<Exact> outputs_of(const ir::Program& program, const std::vector<Exact>& nodes);
std::optional<std::vector<Exact>> exact_values(const ir::Program& program,
                                               const ir::LeafValues<Exact>& leaves);

/// How far two lists are apart: the largest |a − b| over the largest |a| of them all.
double apart(const std::vector<Exact>& a, const std::vector<Exact>& b);

}  // namespace jourdain::tests
