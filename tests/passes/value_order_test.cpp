// In which order values are computed: that in which a processor has to wait least.
#include "passes/value_order.hpp"

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
using ir::Program;
using ir::Signed;

/// A sum and a product of what is there: 4 cycles each; a product that one sum takes is no operation of its own.
TEST(EstimatedCycles, AreThoseOfTheLongestChain) {
  Builder builder;
  const auto y = [&](std::size_t i) { return builder.leaf(LeafKind::kPosition, i); };
  const Signed fused = builder.add(builder.multiply(y(0), y(1)), y(2));
  builder.output("x", -1, -1, builder.multiply(fused, fused));
  EXPECT_EQ(estimated_cycles(builder.finish("square")), 8u);
  Builder apart;
  const Signed product =
      apart.multiply(apart.leaf(LeafKind::kPosition, 0), apart.leaf(LeafKind::kPosition, 1));
  apart.output("p", -1, -1, product);
  apart.output("x", -1, -1, apart.divide(apart.add(product, apart.leaf(LeafKind::kPosition, 2)), product));
  EXPECT_EQ(estimated_cycles(apart.finish("quotient")), 22u);  // 4 + 4 + 14
}

/// Two operations a cycle, at most.
TEST(EstimatedCycles, AreHalfTheOperationsWhereNoneWaits) {
  Builder builder;
  for (int i = 0; i < 40; ++i)
    builder.output("x", i, -1,
                   builder.multiply(builder.leaf(LeafKind::kPosition, static_cast<std::size_t>(i)),
                                    builder.leaf(LeafKind::kVelocity, 0)));
  EXPECT_EQ(estimated_cycles(builder.finish("products")), 19u + 4u);
}

/// A long chain stands behind many operations that nothing waits for: it is begun first.
TEST(OrderValues, BeginsWithTheLongestChain) {
  Builder builder;
  const auto y = [&](std::size_t i) { return builder.leaf(LeafKind::kPosition, i); };
  std::vector<Signed> others;
  for (std::size_t i = 0; i < 100; ++i) others.push_back(builder.multiply(y(i), y(i + 1)));
  Signed chain = y(0);
  for (std::size_t i = 0; i < 40; ++i) chain = builder.divide(y(i + 1), chain);
  builder.output("chain", -1, -1, chain);
  for (std::size_t i = 0; i < others.size(); ++i) builder.output("x", static_cast<int>(i), -1, others[i]);
  const Program before = builder.finish("chain"), after = order_values(before);
  EXPECT_EQ(estimated_cycles(after), 40u * 14u);
  EXPECT_GT(estimated_cycles(before), 40u * 14u + 40u);
  EXPECT_EQ(ir::count_operations(after), ir::count_operations(before));
}

TEST(OrderValues, ComputesTheSameNumbers) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Program before = without_unused(tests::random_program(seed)), after = order_values(before);
    EXPECT_EQ(ir::count_operations(after), ir::count_operations(before)) << seed;
    EXPECT_LE(estimated_cycles(after), estimated_cycles(before)) << seed;
    EXPECT_TRUE(same_operations(order_values(after), after)) << seed;
    const ir::LeafValues<double> leaves = tests::random_leaves(seed);
    const std::vector<double> expected = ir::interpret(before, leaves), found = ir::interpret(after, leaves);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_TRUE(found[i] == expected[i] || (std::isnan(found[i]) && std::isnan(expected[i]))) << seed;
  }
}

}  // namespace
}  // namespace jourdain::passes
