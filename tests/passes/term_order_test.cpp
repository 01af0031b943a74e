// In which order terms are added: what is there first is added first, unless digits are lost.
#include "passes/term_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ir/builder.hpp"
#include "passes/random_program.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::passes {
namespace {

using ir::Builder;
using ir::LeafKind;
using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

/// How many operations wait for each other at most, up to a value.
std::size_t length(const Program& program, ValueId value) {
  const ir::Node& node = program[value];
  std::size_t longest = 0;
  if (ir::operand_count(node.op) >= 1) longest = length(program, node.a) + 1;
  if (ir::operand_count(node.op) == 2) longest = std::max(longest, length(program, node.b) + 1);
  return longest;
}

std::size_t length(const Program& program) { return length(program, program.outputs.at(0).value); }

Signed product(Builder& builder, std::size_t i) {
  return builder.multiply(builder.leaf(LeafKind::kPosition, i), builder.leaf(LeafKind::kVelocity, i));
}

TEST(OrderTerms, AddsPairByPair) {
  Builder builder;
  Signed sum = product(builder, 0);
  for (std::size_t i = 1; i < 16; ++i)
    sum = builder.add(sum, i % 3 == 0 ? -product(builder, i) : product(builder, i));
  builder.output("sum", -1, -1, sum);
  const Program before = builder.finish("sum"), after = order_terms(before);
  EXPECT_EQ(length(before), 16u);
  EXPECT_EQ(length(after), 5u) << print(after);
  EXPECT_EQ(ir::count_operations(after).arithmetic(), ir::count_operations(before).arithmetic());
}

TEST(OrderTerms, MultipliesPairByPair) {
  Builder builder;
  Signed all = builder.leaf(LeafKind::kPosition, 0);
  for (std::size_t i = 1; i < 8; ++i) all = builder.multiply(all, builder.leaf(LeafKind::kPosition, i));
  builder.output("product", -1, -1, all);
  EXPECT_EQ(length(order_terms(builder.finish("product"))), 3u);
}

/// A term that waits for a division is added last, wherever it stands.
TEST(OrderTerms, AddsLastWhatIsThereLast) {
  Builder builder;
  const Signed late = builder.divide(product(builder, 0), product(builder, 1));
  Signed sum = late;
  for (std::size_t i = 2; i < 5; ++i) sum = builder.subtract(sum, product(builder, i));
  builder.output("sum", -1, -1, sum);
  const Program after = order_terms(builder.finish("sum"));
  const ir::Node& last = after[after.outputs[0].value];
  const auto is_late = [&](ValueId value) { return after[value].op == Op::kDivide; };
  EXPECT_TRUE(is_late(last.a) || is_late(last.b)) << print(after);
}

/// Numbers of one size that leave little of each other in pairs stay in pairs, though all that are positive are there
/// first.
TEST(OrderTerms, KeepDigits) {
  constexpr std::size_t kPairs = 8;
  Builder builder;
  std::vector<Signed> lengths;
  for (std::size_t i = 0; i < 2 * kPairs; ++i) {
    const Signed x = builder.leaf(LeafKind::kPosition, i);
    lengths.push_back(builder.unary(Op::kSqrt, builder.add(builder.multiply(x, x), builder.literal(1))));
  }
  Signed sum = builder.literal(0);
  for (std::size_t i = 0; i < kPairs; ++i)
    sum = builder.add(sum, builder.subtract(lengths[i], lengths[kPairs + i]));
  builder.output("sum", -1, -1, sum);
  const Program before = remove_dead_code(builder.finish("sum"));
  EXPECT_EQ(print(order_terms(before)), print(before));
}

TEST(OrderTerms, KeepValuesOfRandomProgramsAndTakeNoMoreOperations) {
  std::size_t changed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Program before = remove_dead_code(tests::random_program(seed)), after = order_terms(before);
    changed += !same_operations(before, after);
    EXPECT_LE(ir::count_operations(after).arithmetic(), ir::count_operations(before).arithmetic());
    const ir::LeafValues<double> leaves = tests::random_leaves(seed);
    const std::vector<double> expected = ir::interpret(before, leaves), actual = ir::interpret(after, leaves);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(actual[i], expected[i], 1e-12 * (1 + std::fabs(expected[i]))) << seed;
  }
  EXPECT_GT(changed, 100u);
}

}  // namespace
}  // namespace jourdain::passes
