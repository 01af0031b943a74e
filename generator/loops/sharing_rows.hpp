// Which rows the multipliers of redundant constraints are shared among.
#pragma once

#include <vector>

#include "loops/configuration.hpp"
#include "loops/plan.hpp"

namespace jourdain::loops {

/// Redundant rows may be so in turn: of the two rows that hold an axis, fixed in a body that turns, now the one follows from the
/// others and now the other. Then no choice stays regular, though the mechanism does. Of `rows`, which are regular, one that does not
/// stay so and those that take its place, if there are any such; in order.
std::vector<std::size_t> sharing_rows(const std::vector<Matrix>& jacobians,
                                      const std::vector<std::size_t>& rows);

/// Regularisation of rows beside those that share, over that of others: R has rank 1 but for it.
inline constexpr double kBesideSharing = 1e-4;

/// What SchurFactors computes, in numbers: S over the solved rows of a plan, without regularisation if `size` is 0, 1/kg.
class SchurSolution {
 public:
  SchurSolution(const LoopPlan& plan, const Matrix& S, double size);

  Vector solved(const Vector& c) const;
  /// What the solution keeps to: of rows that share the combination that counts.
  Vector kept(Vector c) const;
  long double determinant() const;
  /// Of what is inverted.
  long double condition() const;

 private:
  std::vector<Eigen::Index> sure_, sharing_;  ///< positions
  Matrix coupling_;                           ///< S of rows that share with the others
  Eigen::LDLT<Matrix> factors_;               ///< of the others
  Matrix inverse_, kept_;                     ///< over rows that share
  long double determinant_ = 1, condition_ = 1;
};

}  // namespace jourdain::loops
