#include "model/matrix3.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace jourdain::model {
namespace {

constexpr double kRounding = 4e-15;  // some twenty operations on entries of size 3

TEST(SymmetricEigenvalues, OfADiagonalMatrixAreItsEntriesInOrder) {
  EXPECT_EQ(symmetric_eigenvalues({{{3, 0, 0}, {0, -1, 0}, {0, 0, 2}}}), (Numbers3{-1, 2, 3}));
}

TEST(SymmetricEigenvalues, DoNotChangeWhenTheAxesTurn) {
  const Matrix3 diagonal{{{1e-6, 0, 0}, {0, 2, 0}, {0, 0, 2.5}}};
  const Numbers3 values = symmetric_eigenvalues(turned(rotation_from_rpy({0.3, -1.2, 2.1}), diagonal));
  EXPECT_NEAR(values[0], 1e-6, kRounding);
  EXPECT_NEAR(values[1], 2, kRounding);
  EXPECT_NEAR(values[2], 2.5, kRounding);
}

TEST(SymmetricEigenvalues, OfARankOneMatrix) {
  const Numbers3 values = symmetric_eigenvalues({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}});
  EXPECT_NEAR(values[0], 0, kRounding);
  EXPECT_NEAR(values[1], 0, kRounding);
  EXPECT_NEAR(values[2], 3, kRounding);
}

TEST(RotationFromRpy, TurnsAboutFixedAxesXYZ) {
  const Matrix3 R = rotation_from_rpy({0.1, 0.2, 0.3});
  const Matrix3 x = rotation_from_rpy({0.1, 0, 0}), y = rotation_from_rpy({0, 0.2, 0}),
                z = rotation_from_rpy({0, 0, 0.3});
  const Matrix3 chained = product(z, product(y, x));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(R[i][j], chained[i][j], kRounding);
  EXPECT_NEAR(z[1][0], std::sin(0.3), kRounding);
}

TEST(PointInertia, IsThatOfAUnitMass) {
  const Matrix3 inertia = point_inertia({1, 2, 3});
  EXPECT_EQ(inertia[0], (Numbers3{13, -2, -3}));
  EXPECT_EQ(inertia[2][2], 5);
}

}  // namespace
}  // namespace jourdain::model
