// In which order the terms of a sum are added: those first that are there first.
#pragma once

#include "ir/program.hpp"

namespace jourdain::passes {

/// The same values with as many operations, but sums and products are associated so that each is there as early as can
/// be: always the two terms first that are there first. Fewer operations wait for each other then, and a processor that
/// begins several at once is done earlier. Rounding differs; an order that loses digits at sampled arguments is not
/// taken (SampledRounding).
ir::Program order_terms(const ir::Program& program);

/// A program and, of each value, whether it stays a term of its own where it is added to others; of none where empty.
struct Reordered {
  ir::Program program;
  std::vector<bool> apart;
};

Reordered order_terms(const Reordered& given);

}  // namespace jourdain::passes
