// What lengths are measured in where a mechanism is far smaller or larger than usual.
#pragma once

#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::loops {

/// m, rad: tolerances and steps in lengths count as those in angles do where what loops join is 5 cm to 2 m from the
/// origins of its bodies; smaller and larger mechanisms have them in proportion.
struct Units {
  long double length = 1;
  std::vector<long double> rows;  ///< of constraints: `length` where they are lengths, otherwise 1
  std::vector<long double>
      velocities;  ///< of the tree: `length` where they move along a direction, otherwise 1
};

/// At these values of the parameters.
Units units_of(const model::Mechanism& mechanism, const std::vector<double>& parameters);

/// Which rows of constraints are lengths, m.
std::vector<bool> length_rows(const model::Mechanism& mechanism);

}  // namespace jourdain::loops
