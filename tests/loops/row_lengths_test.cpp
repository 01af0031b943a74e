// How rows of constraints are scaled, and how little multipliers leave open.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "agreement/shared_data.hpp"
#include "loops/plan/plan.hpp"

namespace jourdain::loops {
namespace {

LoopPlan plan_of(const std::string& name) {
  support::Diagnostics diagnostics("scene.toml", "");
  const model::Mechanism mechanism =
      tests::read_model(fmt::format("{}/tests/loops/scenes/{}.toml", JOURDAIN_SOURCE_DIR, name));
  const std::optional<LoopPlan> plan = plan_loops(mechanism, diagnostics);
  EXPECT_TRUE(plan) << diagnostics.format();
  return plan.value_or(LoopPlan());
}

/// The rod that holds 400 kg weighs a millionth of the one that holds 1e-4 kg.
TEST(RowLengths, MakeRowsAlikeThatHoldHeavyBodiesAndLightOnes) {
  const LoopPlan plan = plan_of("far_apart");
  ASSERT_EQ(plan.row_length.size(), 2u);
  EXPECT_GT(plan.row_length[0], 100);
  EXPECT_EQ(plan.row_length[1], 1);
}

/// A row that is zero but for rounding follows from the others; scaled up it would bear them.
TEST(RowLengths, LeaveRowsThatHoldNothing) {
  const LoopPlan plan = plan_of("tilted_slide");
  ASSERT_FALSE(plan.redundant.empty());
  EXPECT_LT(*std::max_element(plan.row_length.begin(), plan.row_length.end()), 1e3);
}

/// An expression without a unit may be of any size.
TEST(RowLengths, MakeSmallExpressionsLikeOthers) {
  const LoopPlan plan = plan_of("small_residual");
  EXPECT_EQ(plan.freedom, 1u);
  EXPECT_GT(*std::max_element(plan.row_length.begin(), plan.row_length.end()), 1e5);
}

}  // namespace
}  // namespace jourdain::loops
