// What SchurFactors computes, by dense algebra in 77 digits.
#pragma once

#include <vector>

#include "loops/record/loop_plan.hpp"
#include "reference/exact_algebra.hpp"

namespace jourdain::loops {

using reference::ExactMatrix;
using reference::ExactVector;
using support::ScaledReal;

/// Multipliers of some rows of the constraints, regularised: S + Δ, or what rows that share come to.
class SchurSolution {
 public:
  /// `S` over `rows`; Δ is `size` over the square of a row's length, 1/kg.
  SchurSolution(const LoopPlan& plan, const std::vector<std::size_t>& rows, const ExactMatrix& S,
                double size);

  ExactVector solved(const ExactVector& c) const;
  /// With proximal corrections, see SchurFactors::corrected.
  ExactVector corrected(const ExactVector& c, int corrections) const;
  const ScaledReal& determinant() const { return determinant_; }

 private:
  void share(const LoopPlan& plan, const std::vector<std::size_t>& rows, const ExactMatrix& S, double size);

  std::vector<Eigen::Index> sure_, sharing_;  ///< positions
  ExactVector delta_;
  ExactMatrix regular_, coupling_;  ///< S + Δ of the rows that do not share; S of those that do with them
  ExactMatrix inverse_;             ///< over rows that share
  ScaledReal determinant_ = 1;
};

}  // namespace jourdain::loops
