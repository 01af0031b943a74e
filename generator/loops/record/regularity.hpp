// What is proven of a choice of independent coordinates.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "loops/record/proven_box.hpp"

namespace jourdain::loops {

/// What is proven for all independent coordinates within their ranges (an angle without one: any, however many
/// turns), at all times, for all parameters within their ranges: the branch of the initial state exists, no
/// other one meets it, and what is solved for the dependent coordinates is regular on it.
struct RegularityProof {
  /// Of every block: the least |det| over the product of the largest norms of its rows, columns divided by
  /// their norms at the start. 1 is orthogonal, 0 singular.
  double margin = 1;
  std::string region;                    ///< "crank in [0.5, 2.9], any rocker"; empty where nothing varies
  std::vector<std::string> at_defaults;  ///< parameters at whose given values it holds only
  ProvenBox box;
  std::size_t boxes = 0;  ///< that the region was taken apart into

  /// From dependents that are off by `radius` or less, each, the Newton iterations as emitted (block after
  /// block, `iterations` of each) end within `ends_within` of the branch, in exact arithmetic. rad; slides in
  /// units of `length`.
  double radius = 0;
  double ends_within = 0;
  double length = 1;  ///< m
  /// Within this of the branch there is no other solution; units as above. Dependents within it are off by
  /// `radius` or less where the first corrections of all blocks together, the root of the sum of their
  /// squares, are at most `first_correction`, rad or m.
  double isolation = 0;
  double first_correction = 0;
};

}  // namespace jourdain::loops
