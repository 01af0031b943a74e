#include "ir/jacobian.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

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

/// By the share that leaves operands first; none where an order is looked for.
class Orders : public ::testing::TestWithParam<std::optional<double>> {
 protected:
  static JacobianEntries differentiated(Builder& builder, const std::vector<Signed>& values,
                                        const std::vector<Seed>& seeds) {
    Surroundings surroundings;
    surroundings.forward = GetParam();
    surroundings.is_thorough = true;
    return differentiate(builder, values, seeds, {}, surroundings);
  }
};

TEST_P(Orders, DifferentiateEveryOperation) {
  Builder b;
  const Signed y0 = b.leaf(LeafKind::kPosition, 0), y1 = b.leaf(LeafKind::kPosition, 1), one = b.literal(1);
  const std::vector<Signed> values = {
      b.multiply(b.unary(Op::kSin, y0), y1), b.divide(y0, b.add(y1, b.unary(Op::kCos, y0))),
      -b.unary(Op::kSqrt, b.subtract(y1, b.multiply(y0, y0))), b.atan2(b.multiply(y0, y1), -y1)};
  const JacobianEntries J = differentiated(b, values, {{y0, 0, one}, {y1, 1, one}});
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
      differentiated(b, {b.multiply(y0, y0), b.literal(3), y1}, {{y0, 0, one}, {y1, 1, one}});
  ASSERT_EQ(J.size(), 2u);
  EXPECT_TRUE(J.count({0, 0}));
  EXPECT_TRUE(J.count({2, 1}));
}

TEST_P(Orders, ChainTheDerivativesOfLeaves) {
  Builder b;
  const Signed y0 = b.leaf(LeafKind::kPosition, 0), y1 = b.leaf(LeafKind::kPosition, 1);
  // y0 = 2 x, y1 = −y1 x: d(y0 y1)/dx = 2 y1 − y0 y1.
  const JacobianEntries J = differentiated(b, {b.multiply(y0, y1)}, {{y0, 0, b.literal(2)}, {y1, 0, -y1}});
  EXPECT_DOUBLE_EQ((evaluated(b, J, 5, 7)[{0, 0}]), 14 - 35);
}

/// Roots that exist where they are taken alone, in sums and products that share their terms: derivatives exist wherever
/// the function does, and are not written out once for each way through it, of which there are 2^12.
TEST_P(Orders, TakeFactorsIntoChoicesWithoutGrowing) {
  Builder b;
  const Signed y0 = b.leaf(LeafKind::kPosition, 0), y1 = b.leaf(LeafKind::kPosition, 1), one = b.literal(1);
  const auto where_not_negative = [&b](Signed sign, Signed value) {
    return b.function(support::Function::kWhereNotNegative, sign, value);
  };
  const Signed root = b.unary(Op::kSqrt, y0), more = b.unary(Op::kSqrt, b.add(y0, y1));
  Signed inner = root;
  for (int k = 0; k < 12; ++k) inner = b.divide(b.add(b.multiply(inner, more), root), b.add(inner, more));
  Signed sum = b.add(where_not_negative(y0, inner), where_not_negative(b.subtract(y0, one), more));
  for (int k = 0; k < 12; ++k)
    sum =
        b.add(where_not_negative(b.subtract(y0, b.literal(k)), b.multiply(sum, inner)), b.multiply(sum, y1));
  const auto value = [&](double at) {
    Builder copy = b;
    copy.output("f", -1, -1, sum);
    LeafValues<double> leaves;
    leaves[LeafKind::kPosition] = {at, 0.5};
    return interpret(copy.finish("f"), leaves).at(0);
  };
  const double h = 1e-5;
  const double slope = (value(7.5 + h) - value(7.5 - h)) / (2 * h);
  const JacobianEntries J = differentiated(b, {sum}, {{y0, 0, one}, {y1, 1, one}});
  EXPECT_LE(b.program().nodes.size(), 3000u);
  EXPECT_NEAR((evaluated(b, J, 7.5, 0.5)[{0, 0}]), slope, 1e-7 * std::fabs(slope));
  EXPECT_EQ((evaluated(b, J, -1, 0.5)[{0, 0}]), 0);
  EXPECT_EQ((evaluated(b, J, -1, 0.5)[{0, 1}]), 0);
}

INSTANTIATE_TEST_SUITE_P(Jacobian, Orders, ::testing::Values(std::nullopt, 0, 0.3, 0.7, 1));

}  // namespace
}  // namespace jourdain::ir
