#include "loops/plan/sharing_rows.hpp"

#include "loops/plan/schur_solution.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace jourdain::loops {
namespace {

using Rows = std::vector<std::size_t>;

/// A row that holds x, and two of which one follows from the other: both hold y, more or less as something turns.
Matrix turned(double angle) {
  Matrix G = Matrix::Zero(3, 3);
  G(0, 0) = 1;
  G(1, 1) = std::cos(angle);
  G(2, 1) = std::sin(angle);
  return G;
}

std::vector<Matrix> turning(double until) {
  std::vector<Matrix> jacobians;
  for (int k = 0; k <= 8; ++k) jacobians.push_back(turned(until * k / 8));
  return jacobians;
}

/// Rows 1 and 2 share.
LoopPlan plan_of_turning_rows() {
  LoopPlan plan;
  plan.rows = {0, 1};
  plan.sharing = {1, 2};
  plan.row_length = {1, 1, 2};
  return plan;
}

TEST(SharingRows, AreThoseThatTakeTurns) { EXPECT_EQ(sharing_rows(turning(3), {0, 1}), Rows({1, 2})); }

TEST(SharingRows, AreNoneWhereTheSameRowStaysRedundant) {
  EXPECT_EQ(sharing_rows(turning(0), {0, 1}), Rows());
}

TEST(SharingRows, AreNoneWithoutRedundantRows) {
  const std::vector<Matrix> jacobians = {Matrix::Identity(2, 3), 2 * Matrix::Identity(2, 3)};
  EXPECT_EQ(sharing_rows(jacobians, {0, 1}), Rows());
}

TEST(SchurSolution, SolvesWhicheverRowIsWeak) {
  for (const double angle : {0.0, 0.7, std::acos(0.0)}) {
    const ExactMatrix G = turned(angle).cast<double>().cast<ScaledReal>(), S = G * G.transpose();
    ExactVector z(3);
    z << 1, 2, 3;
    const ExactVector c = G * z,
                      open = S * SchurSolution(plan_of_turning_rows(), {0, 1, 2}, S, 0).solved(c) - c;
    EXPECT_LE(static_cast<double>(open.cwiseAbs().maxCoeff()), 1e-15);  // sines are rounded to double
  }
}

TEST(SchurSolution, LeavesOpenWhatDisagrees) {
  const double cosine = std::cos(0.7), sine = std::sin(0.7);
  const ExactMatrix G = turned(0.7).cast<double>().cast<ScaledReal>();
  const SchurSolution schur(plan_of_turning_rows(), {0, 1, 2}, G * G.transpose(), 0);
  ExactVector odd(3);
  odd << 0, sine, -cosine / 4;  // across the row that both make, in their weights
  EXPECT_LE(static_cast<double>(schur.solved(odd).cwiseAbs().maxCoeff()), 1e-15);
}

}  // namespace
}  // namespace jourdain::loops
