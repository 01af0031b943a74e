#include "ir/jacobian.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace jourdain::ir {
namespace {

/// Values of the entries at y = (y0, y1).
std::map<std::pair<std::size_t, std::size_t>, double> evaluated(Builder builder,
                                                                const JacobianEntries& entries, double y0,
                                                                double y1) {
  for (const auto& [at, value] : entries) builder.output("J", int(at.first), int(at.second), value);
  LeafValues<double> leaves;
  leaves[LeafKind::kPosition] = {y0, y1};
  const std::vector<double> values = interpret(builder.finish("J"), leaves);
  std::map<std::pair<std::size_t, std::size_t>, double> result;
  std::size_t k = 0;
  for (const auto& [at, value] : entries) result[at] = values[k++];
  return result;
}

class Orders : public ::testing::TestWithParam<EliminationOrder> {};

TEST_P(Orders, DifferentiateEveryOperation) {
  Builder b;
  const Signed y0 = b.leaf(LeafKind::kPosition, 0), y1 = b.leaf(LeafKind::kPosition, 1), one = b.literal(1);
  const std::vector<Signed> values = {
      b.multiply(b.unary(Op::kSin, y0), y1), b.divide(y0, b.add(y1, b.unary(Op::kCos, y0))),
      -b.unary(Op::kSqrt, b.subtract(y1, b.multiply(y0, y0))), b.atan2(b.multiply(y0, y1), -y1)};
  const JacobianEntries J = differentiate(b, values, {{y0, 0, one}, {y1, 1, one}}, GetParam());
  auto at = evaluated(b, J, 0.3, 1.7);
  const double s = std::sin(0.3), c = std::cos(0.3), root = std::sqrt(1.7 - 0.09);
  EXPECT_NEAR((at[{0, 0}]), c * 1.7, 1e-15);
  EXPECT_NEAR((at[{0, 1}]), s, 1e-15);
  EXPECT_NEAR((at[{1, 0}]), (1.7 + c + 0.3 * s) / ((1.7 + c) * (1.7 + c)), 1e-15);
  EXPECT_NEAR((at[{1, 1}]), -0.3 / ((1.7 + c) * (1.7 + c)), 1e-15);
  EXPECT_NEAR((at[{2, 0}]), 0.3 / root, 1e-15);
  EXPECT_NEAR((at[{2, 1}]), -0.5 / root, 1e-15);
  EXPECT_NEAR((at[{3, 0}]), -1 / (1 + 0.09), 1e-15);  // the angle of (−y1, y0 y1): atan2(y0, −1) where y1 > 0
  EXPECT_NEAR((at[{3, 1}]), 0, 1e-15);
}

TEST_P(Orders, LeaveOutWhatDoesNotDependOnAColumn) {
  Builder b;
  const Signed y0 = b.leaf(LeafKind::kPosition, 0), y1 = b.leaf(LeafKind::kPosition, 1), one = b.literal(1);
  const JacobianEntries J =
      differentiate(b, {b.multiply(y0, y0), b.literal(3), y1}, {{y0, 0, one}, {y1, 1, one}}, GetParam());
  ASSERT_EQ(J.size(), 2u);
  EXPECT_TRUE(J.count({0, 0}));
  EXPECT_TRUE(J.count({2, 1}));
}

TEST_P(Orders, ChainTheDerivativesOfLeaves) {
  Builder b;
  const Signed y0 = b.leaf(LeafKind::kPosition, 0), y1 = b.leaf(LeafKind::kPosition, 1);
  // y0 = 2 x, y1 = −y1 x: d(y0 y1)/dx = 2 y1 − y0 y1.
  const JacobianEntries J =
      differentiate(b, {b.multiply(y0, y1)}, {{y0, 0, b.literal(2)}, {y1, 0, -y1}}, GetParam());
  EXPECT_DOUBLE_EQ((evaluated(b, J, 5, 7)[{0, 0}]), 14 - 35);
}

INSTANTIATE_TEST_SUITE_P(Jacobian, Orders,
                         ::testing::Values(EliminationOrder{0}, EliminationOrder{0.5}, EliminationOrder{1}));

}  // namespace
}  // namespace jourdain::ir
