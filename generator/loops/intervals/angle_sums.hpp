// Sums of positions under sines and cosines as leaves of their own, so that what cancels in them cancels in enclosures.
#pragma once

#include <utility>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::loops {

/// offset + Σ factor y[position]
struct AngleSum {
  double offset = 0;
  std::vector<std::pair<std::size_t, double>> terms;
};

struct SummedAngles {
  ir::Program program;  ///< position leaves from `first` on stand for the sums, in order
  std::vector<AngleSum> sums;
};

/// Takes sums with whole factors apart, and with offsets that are exact.
SummedAngles with_summed_angles(const ir::Program& program, std::size_t first);

}  // namespace jourdain::loops
