// Every pass on random programs: what it promises and what it keeps. That a second run changes nothing:
// pipeline_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "ir/builder.hpp"
#include "passes/angles.hpp"
#include "passes/constants.hpp"
#include "passes/factor.hpp"
#include "passes/hoist.hpp"
#include "passes/random_program.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::passes {
namespace {

using ir::Builder;
using ir::LeafKind;
using ir::Program;
using ir::Signed;
using tests::random_leaves;
using tests::random_program;

constexpr std::uint64_t kPrograms = 300;

std::size_t operations(const Program& program) { return ir::count_operations(program).arithmetic(); }

TEST(Factor, MultipliesACommonFactorOnce) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), y = b.leaf(LeafKind::kPosition, 1),
               z = b.leaf(LeafKind::kPosition, 2);
  b.output("r", -1, -1, b.subtract(b.multiply(x, y), b.multiply(x, z)));
  EXPECT_EQ(print(factor(b.finish("p"))),
            "program p\n%0 = y[0]\n%1 = y[1]\n%2 = y[2]\n%3 = sub %1 %2\n%4 = mul %0 %3\nr := %4\n");
}

TEST(Factor, LeavesProductsAloneThatOthersUse) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), y = b.leaf(LeafKind::kPosition, 1),
               z = b.leaf(LeafKind::kPosition, 2);
  const Signed xy = b.multiply(x, y), xz = b.multiply(x, z);
  b.output("r", 0, -1, b.add(xy, xz));
  b.output("r", 1, -1, xy);
  b.output("r", 2, -1, xz);
  EXPECT_EQ(operations(factor(b.finish("p"))), 3u);
}

TEST(Factor, NeverAddsOperationsAndKeepsValuesToRounding) {
  std::size_t saved = 0;
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed) {
    const Program before = random_program(seed), after = factor(before);
    ASSERT_LE(operations(after), operations(remove_dead_code(before))) << print(before);
    saved += operations(remove_dead_code(before)) - operations(after);
    const auto leaves = random_leaves(seed);
    const auto expected = ir::interpret(before, leaves), actual = ir::interpret(after, leaves);
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_NEAR(actual[i], expected[i], 1e-9 * (1 + std::fabs(expected[i]))) << print(before);
  }
  EXPECT_GT(saved, 0u);
}

TEST(GroupConstants, MultipliesConstantsWithEachOtherFirst) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), p = b.leaf(LeafKind::kParameter, 0);
  const Signed twice = b.multiply(b.literal(2), x);
  b.output("r", 0, -1, b.multiply(b.literal(0.5), twice));
  const Signed xx = b.multiply(x, x), pp = b.multiply(p, p);
  b.output("r", 1, -1, b.divide(b.multiply(p, xx), pp));
  EXPECT_EQ(print(group_constants(b.finish("p"))),
            "program p\n%0 = y[0]\n%1 = parameter[0]\n%2 = mul %0 %0\n%3 = mul %1 %1\n%4 = div %1 %3\n"
            "%5 = mul %2 %4\nr[0] := %0\nr[1] := %5\n");
}

TEST(GroupConstants, KnowsThatAValueTimesItsReciprocalIsOne) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), p = b.leaf(LeafKind::kParameter, 0);
  const Signed inverse = b.divide(b.literal(1), p);
  b.output("r", 0, -1, b.multiply(x, b.multiply(p, inverse)));
  b.output("r", 1, -1, b.multiply(-x, b.divide(b.literal(1), x)));
  b.output("r", 2, -1, b.multiply(x, b.divide(b.literal(2), x)));
  const Program grouped = group_constants(b.finish("p"));
  EXPECT_EQ(operations(grouped), 0u) << print(grouped);
  const auto leaves = random_leaves(1);
  const std::vector<double> values = ir::interpret(grouped, leaves);
  EXPECT_EQ(values[0], leaves[LeafKind::kPosition][0]);
  EXPECT_EQ(values[1], -1);
  EXPECT_EQ(values[2], 2);
}

TEST(Settled, KeepsTheFirstOfTwoProgramsThatBecomeEachOther) {
  Program both[2];
  for (const unsigned first : {0u, 1u}) {
    Builder b;
    const Signed x = b.leaf(LeafKind::kPosition, first), y = b.leaf(LeafKind::kPosition, 1 - first);
    b.output("r", 0, -1, b.add(x, y));
    both[first] = b.finish("p");
  }
  ASSERT_FALSE(same_operations(both[0], both[1]));
  for (const Program& program : both) {
    int runs = 0;
    const Program kept = settled(program, [&](const Program& p) {
      ++runs;
      return same_operations(p, both[0]) ? both[1] : both[0];
    });
    EXPECT_EQ(print(kept), print(program));
    EXPECT_EQ(runs, 2);
  }
}

TEST(GroupConstants, AddsConstantsToEachOtherFirst) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), p = b.leaf(LeafKind::kParameter, 0);
  b.output("r", 0, -1, b.add(b.subtract(b.add(x, b.literal(1.5)), p), b.literal(2.5)));
  EXPECT_EQ(print(group_constants(b.finish("p"))),
            "program p\n%0 = y[0]\n%1 = parameter[0]\n%2 = 4\n%3 = sub %1 %2\n%4 = sub %0 %3\nr[0] := %4\n");
}

TEST(GroupConstants, KeepsAPartialSumThatIsUsedElsewhere) {
  Builder b;
  const Signed sum = b.add(b.leaf(LeafKind::kPosition, 0), b.literal(1.5));
  b.output("r", 0, -1, b.add(sum, b.literal(2.5)));
  b.output("r", 1, -1, sum);
  EXPECT_EQ(operations(group_constants(b.finish("p"))), 2u);
}

TEST(GroupConstants, DividesInsteadOfMultiplyingWithAReciprocalUsedOnce) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), d = b.leaf(LeafKind::kPosition, 1);
  const Signed e = b.leaf(LeafKind::kPosition, 2), inverse = b.divide(b.literal(1), e);
  b.output("r", 0, -1, b.multiply(x, b.divide(b.literal(1), d)));
  b.output("r", 1, -1, b.multiply(x, inverse));
  b.output("r", 2, -1, b.multiply(d, inverse));
  const Program grouped = group_constants(b.finish("p"));
  EXPECT_EQ(ir::count_operations(grouped).divide, 2u) << print(grouped);
  EXPECT_EQ(operations(grouped), 4u) << print(grouped);
}

TEST(GroupConstants, NeverAddsOperationsAndKeepsValuesToRounding) {
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed) {
    const Program before = random_program(seed), after = group_constants(before);
    ASSERT_LE(operations(after), operations(remove_dead_code(before))) << print(before);
    const auto leaves = random_leaves(seed);
    const auto expected = ir::interpret(before, leaves), actual = ir::interpret(after, leaves);
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_NEAR(actual[i], expected[i], 1e-9 * (1 + std::fabs(expected[i]))) << print(before);
  }
}

TEST(RemoveDeadCode, GivesTheSameBits) {
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed) {
    const Program before = random_program(seed), after = remove_dead_code(before);
    ASSERT_EQ(ir::interpret(after, random_leaves(seed)), ir::interpret(before, random_leaves(seed)))
        << print(before);
    const std::vector<std::size_t> uses = ir::use_counts(after);
    for (std::size_t i = 0; i < uses.size(); ++i) ASSERT_GT(uses[i], 0u) << print(after);
  }
}

ir::Module module_of(const Program& program) { return {{}, {program}}; }

TEST(Hoist, LeavesNoOperationOnParametersAloneAndGivesTheSameBits) {
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed) {
    const Program before = random_program(seed);
    const ir::Module after = hoist(module_of(before));
    const Program& function = after.functions[0];
    std::vector<bool> fixed(function.nodes.size());
    for (std::size_t i = 0; i < function.nodes.size(); ++i) {
      const ir::Node& node = function.nodes[i];
      const int operands = ir::operand_count(node.op);
      fixed[i] = operands == 0 ? node.op == ir::Op::kLiteral || node.leaf == LeafKind::kConstant
                               : fixed[node.a.value] && (operands == 1 || fixed[node.b.value]);
      ASSERT_FALSE(operands > 0 && fixed[i] && node.op != ir::Op::kNegate) << print(function);
      ASSERT_FALSE(node.op == ir::Op::kLeaf && node.leaf == LeafKind::kParameter);
    }
    auto leaves = random_leaves(seed);
    const auto expected = ir::interpret(before, leaves);
    leaves[LeafKind::kConstant] = ir::interpret(after.constants, leaves);
    ASSERT_EQ(ir::interpret(function, leaves), expected) << print(before);
  }
}

TEST(SplitAngles, KeepsTheDigitsThatASumOfLargeAnglesLoses) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0), y = b.leaf(LeafKind::kPosition, 1),
               z = b.leaf(LeafKind::kPosition, 2), sum = b.add(b.add(x, y), -z);
  b.output("s", 0, -1, b.unary(ir::Op::kSin, sum));
  b.output("c", 0, -1, b.unary(ir::Op::kCos, sum));
  const Program program = b.finish("sum"), split = split_angles(program);
  ir::LeafValues<double> leaves;
  leaves[LeafKind::kPosition] = {1e9 + 0.3, 2e9 - 0.7, 7e8 + 0.1};
  const std::vector<double>& angles = leaves[LeafKind::kPosition];
  const long double exact = static_cast<long double>(angles[0]) + angles[1] - angles[2];  // without rounding
  const std::vector<double> values = ir::interpret(split, leaves), rounded = ir::interpret(program, leaves);
  EXPECT_NEAR(values[0], double(std::sin(exact)), 1e-15);
  EXPECT_NEAR(values[1], double(std::cos(exact)), 1e-15);
  EXPECT_GT(std::fabs(rounded[0] - double(std::sin(exact))), 1e-9);
  EXPECT_EQ(operations(split), 12u);
}

/// sin and cos of a sum (or difference) of two angles, split, at angles for which all four products differ.
std::vector<double> split_pair(double a, double b, bool difference) {
  Builder builder;
  const Signed x = builder.leaf(LeafKind::kPosition, 0), y = builder.leaf(LeafKind::kPosition, 1),
               angle = builder.add(x, difference ? -y : y);
  builder.output("s", 0, -1, builder.unary(ir::Op::kSin, angle));
  builder.output("c", 0, -1, builder.unary(ir::Op::kCos, angle));
  ir::LeafValues<double> leaves;
  leaves[LeafKind::kPosition] = {a, b};
  return ir::interpret(split_angles(builder.finish("pair")), leaves);
}

// sin(a ± b) = sin a cos b ± cos a sin b, cos(a ± b) = cos a cos b ∓ sin a sin b.
TEST(SplitAngles, ExpandsSumsAndDifferencesWithTheirSigns) {
  constexpr double kRounding = 2e-16;
  const std::vector<double> sum = split_pair(0.9, 0.4, false), difference = split_pair(0.9, 0.4, true);
  EXPECT_NEAR(sum[0], std::sin(1.3), kRounding);
  EXPECT_NEAR(sum[1], std::cos(1.3), kRounding);
  EXPECT_NEAR(difference[0], std::sin(0.5), kRounding);
  EXPECT_NEAR(difference[1], std::cos(0.5), kRounding);
}

TEST(SplitAngles, LeavesAConstantOffsetInItsSum) {
  Builder b;
  const Signed x = b.leaf(LeafKind::kPosition, 0);
  b.output("s", 0, -1, b.unary(ir::Op::kSin, b.add(x, b.literal(0.5))));
  const Program program = b.finish("offset");
  EXPECT_EQ(print(split_angles(program)), print(program));
}

}  // namespace
}  // namespace jourdain::passes
