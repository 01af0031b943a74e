// x + c + d → x + (c + d): the constant terms of a sum are added to each other first; a part of group_constants.
#pragma once

#include "ir/program.hpp"

namespace jourdain::passes {

/// Reassociating. Of sums whose partial sums are used nowhere else, the terms that are literals or depend on
/// parameters alone become one, where there are several; it comes last. Literals fold, hoisting takes the others.
ir::Program group_constant_terms(const ir::Program& program);

}  // namespace jourdain::passes
