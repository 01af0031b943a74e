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

TEST(RotationMatrix, OfAnEighthOfATurnHasEqualEntries) {
  for (const double eighth :
       {0.7853981633974483, -0.78539816339744828, 2.3561944901923448, -8.6393797973719322}) {
    Statements statements;
    const Matrix3 R = rotation_matrix(rotation(0, 0, eighth), {}, true, statements);
    const GiNaC::numeric c = GiNaC::ex_to<GiNaC::numeric>(R[0][0]), s = GiNaC::ex_to<GiNaC::numeric>(R[1][0]);
    EXPECT_TRUE(GiNaC::abs(c).is_equal(GiNaC::abs(s))) << eighth;
    EXPECT_NEAR(value(c), std::cos(eighth), 2e-15);
    EXPECT_NEAR(value(s), std::sin(eighth), 2e-15);
    const Matrix3 as_read = rotation_matrix(rotation(0, 0, eighth), {}, false, statements);
    EXPECT_FALSE(GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(as_read[0][0])).is_equal(GiNaC::abs(c)));
  }
}

TEST(RotationMatrix, OfATwelfthOfATurnHasHalves) {
  const double pi = std::acos(-1.0);
  for (int sixths = -13; sixths <= 13; ++sixths) {
    Statements statements;
    const Matrix3 R = rotation_matrix(rotation(sixths * pi / 6, 0, 0), {}, true, statements);
    EXPECT_NEAR(value(R[1][1]), std::cos(sixths * pi / 6), 4e-15) << sixths;
    EXPECT_NEAR(value(R[2][1]), std::sin(sixths * pi / 6), 4e-15) << sixths;
    if (sixths % 3 != 0) {
      const Ex half = GiNaC::numeric(1, 2);
      EXPECT_TRUE(R[1][1].is_equal(half) || R[1][1].is_equal(-half) || R[2][1].is_equal(half) ||
                  R[2][1].is_equal(-half))
          << sixths;
    }
  }
}

TEST(RotationMatrix, KeepsOtherAngles) {
  Statements statements;
  const Matrix3 R = rotation_matrix(rotation(1.57079632679, 0, 0), {}, true, statements);
  EXPECT_NEAR(value(R[1][1]), 4.9e-12, 1e-13);
  const Matrix3 near_eighth = rotation_matrix(rotation(0.785398163397, 0, 0), {}, true, statements);
  EXPECT_NEAR(value(near_eighth[1][1] - near_eighth[2][1]), std::sqrt(2) * 4.483e-13, 1e-15);
  const Matrix3 fifteenth = rotation_matrix(rotation(0.2617993877991494, 0, 0), {}, true, statements);
  EXPECT_NEAR(value(fifteenth[1][1]), std::cos(0.2617993877991494), 1e-16);
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
