// Times of single steps: their quantiles, and what they are taken of.
#include "studies/step_cost.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "studies/judged.hpp"

namespace jourdain::tests {
namespace {

TEST(Quantiles, AreNearestRanks) {
  std::vector<double> samples(1000);
  std::iota(samples.rbegin(), samples.rend(), 1);
  const Quantiles q = quantiles_of(samples);
  EXPECT_EQ(q.count, 1000);
  EXPECT_EQ(q.median, 500);
  EXPECT_EQ(q.q99, 990);
  EXPECT_EQ(q.q999, 999);
  EXPECT_EQ(q.worst, 1000);
}

TEST(Quantiles, OfOneSampleAreThatSample) {
  const Quantiles q = quantiles_of({3});
  EXPECT_EQ(q.median, 3);
  EXPECT_EQ(q.q999, 3);
  EXPECT_EQ(q.worst, 3);
}

TEST(FaintVelocity, HasASubnormalSquare) {
  const double faint = faint_velocity(0x1p-53);
  EXPECT_EQ(std::fpclassify(faint), FP_NORMAL);
  EXPECT_EQ(std::fpclassify(faint * faint), FP_SUBNORMAL);
  const auto faint_float = static_cast<float>(faint_velocity(0x1p-24));
  EXPECT_EQ(std::fpclassify(faint_float), FP_NORMAL);
  EXPECT_EQ(std::fpclassify(faint_float * faint_float), FP_SUBNORMAL);
}

/// The rounding mode and the treatment of subnormal numbers are the caller's.
TEST(StepCosts, LeaveSubnormalNumbersAsTheyWere) {
  const EmittedModel model =
      emitted_model("pendulum", {"initial_state", "forward_dynamics", "position_rate", "inverse_dynamics",
                                 "kinetic_energy", "potential_energy", "rk4_step", "euler_step"});
  const ConstantInputs none({});
  const Flow<double> flow(model.table(), none);
  const std::vector<StepCost> costs = measure_step_costs(flow, {true}, {1e-3, 1000, 2}, kSilent);
  volatile double faint = 1e-160;
  EXPECT_EQ(std::fpclassify(faint * faint), FP_SUBNORMAL);
  ASSERT_EQ(costs.size(), 2u);
  // Four evaluations take longer than one, in the same run and by a wide margin; a coarse clock may see neither.
  const std::size_t rk4 = method_called(model.table(), "rk4"), euler = method_called(model.table(), "euler");
  EXPECT_GE(costs[rk4].warm.median, costs[euler].warm.median);
}

}  // namespace
}  // namespace jourdain::tests
