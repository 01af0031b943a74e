// One block of a loop constraint solved: two links between known places, or one.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "loops/closed_form/polynomial.hpp"
#include "loops/closed_form/roots.hpp"

namespace jourdain::loops {

struct Solution {
  std::vector<Known>
      unknowns;  ///< in the order of the polynomials' unknowns; directions for angles, values for others
  std::vector<Condition> conditions;
  std::optional<Matrix3> rotation = {};  ///< that the last four unknowns are the quaternion of
};

/// Solves `rows` = 0 for as many unknowns, one or two; of two solutions the one that passes through `initial`
/// values of them is taken. Otherwise why not, a phrase for the user.
std::variant<Solution, std::string> solve(ir::Builder& builder, std::vector<Polynomial> rows,
                                          const std::vector<double>& initial, const Samples& samples);

/// Leaves out coefficients that are at most `nothing` of their row's largest at all samples, computed with 60 digits:
/// what a file's digits disagree by stays.
void drop_nothing(std::vector<Polynomial>& rows, const Samples& samples, double nothing);

}  // namespace jourdain::loops
