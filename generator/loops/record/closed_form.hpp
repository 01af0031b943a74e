// The closed form of a mechanism's dependent positions, with what is proven of it.
#pragma once

#include <string>
#include <vector>

#include "ir/program.hpp"
#include "loops/record/proven_box.hpp"

namespace jourdain::loops {

struct ClosedForm {
  /// Outputs ("y", k) for each dependent k, block by block. An angle is the solution nearest to the y[k] that
  /// is given, so that whole turns are kept; of other dependents the given value has no influence.
  /// "regularity" is the product of the discriminants, each as sin² of the angle from a dead position, and of the
  /// squares of those determinants,
  /// "opening" the square of the change from the values given.
  ir::Program close;
  /// Over the declared ranges: of every discriminant, as sin² of the angle from a dead position, a lower bound
  /// that interval arithmetic proves. 1 where no root is taken.
  double smallest_margin = 1;
  /// Of what velocities are solved for, as shares of those at the start: a lower bound of their determinants, proven
  /// likewise.
  double least_determinant = 1;
  /// Of the eliminations asked for: proven never to divide by zero?
  std::vector<bool> has_pivots = {};
  /// Parameters of the constraints without a range: all this holds at their values in the request.
  std::vector<std::string> at_defaults = {};
  ProvenBox box = {};
};

}  // namespace jourdain::loops
