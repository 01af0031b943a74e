// Scenes and states at the ends of what engineers may describe: where rounding, range and conditioning are worst. Each
// family sweeps one quantity over many orders of magnitude; the tests take a few of its values, the benchmark all.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "agreement/judge.hpp"

namespace jourdain::tests {

/// What no evaluation of the emitted formulas can avoid, as a multiple of the usual rounding.
enum class Loss {
  kNone,
  /// The sum of the angles of parallel joints, or an angle as a function of time, is rounded with its size: as much as
  /// rounding the state itself would change.
  kLargeAngle,
  /// A body's second moments are turned by differences of their size: a moment about an axis near which all
  /// mass lies has the rounding of the largest moment.
  kSmallMoment
};

/// One swept quantity. Its values are 2^exponent, so that the numbers of a description are numbers of float as
/// well and both precisions evaluate the same mechanism (all families but the Panda's).
struct Family {
  std::string name;
  std::string swept;                                         ///< the quantity, with its unit
  int first = 0, last = 0, step = 1;                         ///< exponents of 2
  std::function<std::string(double value)> description;      ///< TOML
  std::function<void(double value, Sample& sample)> adjust;  ///< of a random state
  bool in_scene = true;  ///< the quantity is in the description, not in the state alone
  Loss loss = Loss::kNone;
};

/// All families; a new one is one entry.
const std::vector<Family>& extreme_families();

/// Exponents of a family's sweep, rising. With `count` that many, the first and the last among them.
std::vector<int> exponents(const Family& family);
std::vector<int> exponents(const Family& family, int count);

/// Reads a description that has no errors.
model::Mechanism read_scene(const std::string& toml);

}  // namespace jourdain::tests
