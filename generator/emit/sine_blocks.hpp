// Sines and cosines of several angles in one call, for number types that compute them side by side.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "emit/tree.hpp"

namespace jourdain::emit {

struct SineBlocks {
  Statements body;
  std::vector<std::size_t> sizes;  ///< angles of each block, in order: 4, 3 or 2
};

/// The same values: pairs of angles that are known when a body begins are computed first, by `sine_cosine4`,
/// `sine_cosine3` and `sine_cosine2`; one that is left over comes after them. Nothing where there are no two.
std::optional<SineBlocks> in_sine_blocks(const Statements& body);

}  // namespace jourdain::emit
