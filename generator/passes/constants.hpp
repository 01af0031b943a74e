// Reassociating pass: the constant factors of a product are multiplied with each other first, the constant terms
// of a sum added, and reciprocals cancel.
#pragma once

#include "ir/program.hpp"

namespace jourdain::passes {

/// c (d x) becomes (c d) x, and (c x)/d becomes (c/d) x, where c and d are literals or depend on parameters
/// alone and the inner product is used once. Two literals fold to one; hoisting takes the others out of the function.
/// x + c + d becomes x + (c + d) (constant_terms.hpp).
/// x (1/d) becomes x/d where 1/d is used once and not constant.
/// A value times its reciprocal becomes 1, also at 0, where the product is no number.
ir::Program group_constants(const ir::Program& program);

}  // namespace jourdain::passes
