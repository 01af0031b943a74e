// For which positions and parameters something is proven of loops.
#pragma once

#include <cstddef>
#include <vector>

namespace jourdain::loops {

struct ProvenRange {
  std::size_t index = 0;
  double low = 0, high = 0;
};

struct ProvenBox {
  std::vector<ProvenRange> positions;   ///< entries of y; others may be anywhere
  std::vector<ProvenRange> parameters;  ///< that constraints depend on; one value where no range is declared
};

}  // namespace jourdain::loops
