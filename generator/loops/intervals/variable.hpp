// Leaves of programs that proofs vary.
#pragma once

#include <cstddef>

#include "ir/program.hpp"

namespace jourdain::loops {

struct Variable {
  ir::LeafKind kind = ir::LeafKind::kPosition;
  std::size_t index = 0;

  friend bool operator==(const Variable&, const Variable&) = default;
};

}  // namespace jourdain::loops
