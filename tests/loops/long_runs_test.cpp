// Loops that stay closed over a million steps, in the emitted code of every model that has loops.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "embed/emitted_models.hpp"
#include "properties/effort.hpp"

namespace jourdain::tests {
namespace {

/// m; of rows without a length: without unit.
constexpr double kOpen = 1e-12;
const long kSteps = static_cast<long>(cases(1000000));

/// Runs at a step (s) that `jourdain report` recommends for the model, or a shorter one.
template <class Model>
void expect_closed(const char* name, const Model& model, double h) {
  typename Model::State state = initial_state(model);
  double worst = 0;
  for (long i = 0; i < kSteps; ++i) {
    rk4_step(model, state, {}, h);
    double g[Model::constraint_count], rate[Model::constraint_count];
    constraint_residual(model, state, g, rate);
    for (const double row : g) worst = std::fabs(row) <= worst ? worst : std::fabs(row);
  }
  fmt::print("{}: {} steps of {} s, |g| up to {:.1e}\n", name, kSteps, h, worst);
  EXPECT_LT(worst, kOpen) << name;
}

TEST(LongRuns, KeepTheLoopsClosed) {
  expect_closed("four_bar", four_bar::Model<>(), 5e-3);
  expect_closed("slider_crank", slider_crank::Model<>(), 2e-4);
  expect_closed("n_four_bar", n_four_bar::Model<>(), 5e-4);
  expect_closed("squeezer", squeezer::Model<>(), 1e-5);
  expect_closed("spring_four_bar", spring_four_bar::Model<>(), 1e-2);
  expect_closed("spatial_slider_crank", spatial_slider_crank::Model<>(), 4e-3);
  expect_closed("double_wishbone", double_wishbone::Model<>(), 4e-3);
  expect_closed("mcpherson_strut", mcpherson_strut::Model<>(), 4e-3);
  expect_closed("parallel_robot", parallel_robot::Model<>(), 4e-3);
}

}  // namespace
}  // namespace jourdain::tests
