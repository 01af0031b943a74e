// One block of a loop constraint solved: two links between known places, or one.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "loops/polynomial.hpp"
#include "loops/samples.hpp"

namespace jourdain::loops {

/// What must be positive wherever the solution is used.
struct Condition {
  Scalar value;
  /// sin² of the angle from a dead position, where two solutions meet; otherwise the square of a divisor.
  bool is_margin = true;
};

struct Solution {
  std::vector<Known>
      unknowns;  ///< in the order of the polynomials' unknowns; directions for angles, values for others
  std::vector<Condition> conditions;
};

/// Solves `rows` = 0 for as many unknowns, one or two; of two solutions the one that passes through `initial` values of them
/// is taken. Otherwise why not, a phrase for the user.
std::variant<Solution, std::string> solve(ir::Builder& builder, std::vector<Polynomial> rows,
                                          const std::vector<double>& initial, const Samples& samples);

/// Leaves out coefficients that are nothing but rounding at all samples.
void drop_rounding(std::vector<Polynomial>& rows, const Samples& samples);

}  // namespace jourdain::loops
