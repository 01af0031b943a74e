#include "ir/builder.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace jourdain::ir {
namespace {

TEST(Builder, SharesProductsAcrossOutputs) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), y = b.leaf(LeafKind::kPosition, 1);
  b.output("q", 0, -1, b.add(b.multiply(x, y), x));
  b.output("q", 1, -1, b.multiply(y, x));
  EXPECT_EQ(print(b.finish("shared")),
            "program shared\n"
            "%0 = y[0]\n"
            "%1 = y[1]\n"
            "%2 = mul %0 %1\n"
            "%3 = add %0 %2\n"
            "q[0] := %3\n"
            "q[1] := %2\n");
}

TEST(Builder, KnowsThatALiteralTimesItsReciprocalIsOne) {
  Builder b;
  const Signed number = b.literal(0.7), one = b.multiply(number, b.divide(b.literal(1), number));
  EXPECT_TRUE(b.is_literal(one, 1));
}

TEST(Builder, KnowsThatLiteralsCancelButForTheirRounding) {
  Builder b;
  const cln::cl_F third = cln::cl_float(cln::cl_RA("1/3"), cln::float_format(63));
  const auto less = [&](const char* share) { return -b.literal(third * (cln::cl_R(1) - cln::cl_R(share))); };
  EXPECT_TRUE(b.is_literal(b.add(b.literal(third), less("1.0e-62_70")), 0));
  EXPECT_FALSE(b.is_literal(b.add(b.literal(third), less("1.0e-55_70")), 0));
}

TEST(Builder, MovesSignsOutward) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), y = b.leaf(LeafKind::kPosition, 1);
  const Signed difference = b.subtract(y, x), sine = b.unary(Op::kSin, -y);
  b.output("q", 0, -1, b.multiply(difference, -sine));
  EXPECT_EQ(print(b.finish("signs")),
            "program signs\n"
            "%0 = y[0]\n"
            "%1 = y[1]\n"
            "%2 = sub %0 %1\n"
            "%3 = sin %1\n"
            "%4 = mul %2 %3\n"
            "%5 = neg %4\n"
            "q[0] := %5\n");
}

TEST(Builder, SimplifiesZeroOneAndEqualOperands) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kVelocity, 0), zero = b.literal(0), one = b.literal(1);
  EXPECT_EQ(b.add(x, zero).value, x.value);
  EXPECT_EQ(b.multiply(one, x).value, x.value);
  EXPECT_TRUE(b.is_literal(b.multiply(x, zero), 0));
  EXPECT_TRUE(b.is_literal(b.subtract(x, x), 0));
  EXPECT_TRUE(b.is_literal(b.add(b.literal(2), b.literal(-5)), -3));
  EXPECT_EQ(b.divide(x, one).value, x.value);
  EXPECT_TRUE(b.multiply(b.literal(-1), x).negative);
}

TEST(Builder, KeepsSignsInsideAnArctangent) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), y = b.leaf(LeafKind::kPosition, 1);
  b.output("q", 0, -1, b.atan2(-x, y));
  EXPECT_EQ(print(b.finish("atan2")),
            "program atan2\n"
            "%0 = y[0]\n"
            "%1 = y[1]\n"
            "%2 = neg %0\n"
            "%3 = atan2 %2 %1\n"
            "q[0] := %3\n");
}

TEST(Builder, FoldsTheArctangentThatIsExact) {
  Builder b;
  EXPECT_TRUE(b.is_literal(b.atan2(b.literal(0), b.literal(2)), 0));
  b.output("half_turn", -1, -1, b.atan2(b.literal(0), b.literal(-2)));
  EXPECT_EQ(interpret(b.finish("fold"), LeafValues<double>{}), std::vector<double>{std::acos(-1.0)});
}

TEST(Interpreter, ComputesEveryOperation) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), u = b.leaf(LeafKind::kInput, 0);
  b.output("r", 0, -1, b.divide(b.unary(Op::kSqrt, x), u));
  b.output("r", 1, -1, -b.unary(Op::kCos, b.subtract(x, u)));
  b.output("r", 2, -1, b.atan2(u, -x));
  const Program program = b.finish("all");
  LeafValues<double> leaves;
  leaves[LeafKind::kPosition] = {4};
  leaves[LeafKind::kInput] = {0.5};
  EXPECT_EQ(interpret(program, leaves), (std::vector<double>{4.0, -std::cos(3.5), std::atan2(0.5, -4.0)}));
  const Operations count = count_operations(program);
  EXPECT_EQ(count.arithmetic(), 3u);
  EXPECT_EQ(count.negate, 2u);
  EXPECT_EQ(count.cos, 1u);
  EXPECT_EQ(count.atan2, 1u);
}

TEST(Interpreter, AssertsThatLeavesAreThere) {
  Builder b;
  b.output("r", 0, -1, b.leaf(LeafKind::kInput, 3));
  EXPECT_THROW(interpret(b.finish("leaf"), LeafValues<double>{}), support::InternalError);
}

}  // namespace
}  // namespace jourdain::ir
