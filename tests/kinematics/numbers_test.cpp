#include "kinematics/numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/high_precision.hpp"

namespace jourdain::kinematics {
namespace {

double value(const Ex& number) {
  return dynamics::to_double(dynamics::HighPrecision(Statements{}, {}).value(number));
}

TEST(Exact, IsTheRationalThatADoubleIs) {
  EXPECT_TRUE(exact(0.5).is_equal(GiNaC::numeric(1, 2)));
  EXPECT_FALSE(exact(0.1).is_equal(GiNaC::numeric(1, 10)));
  EXPECT_EQ(value(exact(0.1)), 0.1);
  EXPECT_THROW(exact(INFINITY), support::InternalError);
}

model::Rotation rotation(double roll, double pitch, double yaw) { return {{roll, pitch, yaw}}; }

TEST(RotationMatrix, OfQuarterTurnsInDoubleIsAPermutation) {
  Statements statements;
  const Matrix3 R =
      rotation_matrix(rotation(1.5707963267948966, 0, -3.141592653589793), {}, true, statements);
  const int expected[3][3] = {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_TRUE(R[i][j].is_equal(expected[i][j])) << i << j;
}

TEST(RotationMatrix, KeepsOtherAngles) {
  Statements statements;
  const Matrix3 R = rotation_matrix(rotation(1.57079632679, 0, 0), {}, true, statements);
  EXPECT_NEAR(value(R[1][1]), 4.9e-12, 1e-13);
}

TEST(RotationMatrix, IsOrthonormalToSixtyDigits) {
  Statements statements;
  const Matrix3 R = rotation_matrix(rotation(0.3, -1.1, 2.5), {}, true, statements);
  const Matrix3 I = settled(R * transpose(R));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_TRUE(I[i][j].is_equal(i == j ? 1 : 0)) << i << j;
  EXPECT_DOUBLE_EQ(value(R[1][0]), std::sin(2.5) * std::cos(-1.1));
}

TEST(UnitVector, IsExactOnAxes) {
  const Vector3 z = unit_vector({0, 0, -4});
  EXPECT_TRUE(z[2].is_equal(-1));
  const Vector3 v = unit_vector({1, 2, 3});
  EXPECT_DOUBLE_EQ(value(v[2]), 3 / std::sqrt(14.0));
}

}  // namespace
}  // namespace jourdain::kinematics
