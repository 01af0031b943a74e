// The oracle of free motion: the descriptor form of a mechanism, in absolute coordinates, integrated with a
// method of high order at two tolerances, so that it says itself how far it can be believed.
#pragma once

#include <vector>

#include "model/mechanism.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::tests {

using PlacedBodies = std::vector<reference::AbsoluteBody<double>>;

/// Largest difference of two placements: of centres of mass over `size` (m), of orientations in rad. NaN where one is.
double difference(const PlacedBodies& a, const PlacedBodies& b, double size);

/// When bodies are looked at: at 0, `interval`, …, `count` intervals; s.
struct Looks {
  double interval = 0.05;
  std::size_t count = 40;
};

struct KnownMotion {
  std::vector<PlacedBodies> bodies;  ///< at the looks; ends where integration costs too much
  /// By look, difference of the two tolerances so far, at least kOwnError; no reference where it is above kAgreement.
  std::vector<double> doubt;

  /// Looks at which the reference agrees with itself, beginning with the first.
  std::size_t known() const;
};

inline constexpr double kAgreement = 1e-6;

/// Rows that the linkages here need have singular values of 1e-2 and more, but near singular positions.
inline constexpr double kRedundant = 1e-4;

/// Motion from the description's initial values, which must meet the loops to rounding. Of the loops' rows
/// those combinations count that have singular values above kRedundant of the largest: stages are off the
/// constraints by what they err, and there redundant rows are not quite so. A mechanism whose axes are rounded
/// has no motion, strictly: ask for that of the ideal one.
KnownMotion known_motion(const model::Mechanism& mechanism, double size, const Looks& looks);

}  // namespace jourdain::tests
