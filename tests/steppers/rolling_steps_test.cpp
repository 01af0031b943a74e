// Steps of what rolls and glides without slip: orders of every stepper, a sleigh along its closed form, a disc for a
// million steps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "rolling_disc_steps/rolling_disc_steps_kernels.hpp"
#include "sleigh_all/sleigh_all_kernels.hpp"
#include "steppers/measured_order.hpp"
#include "steppers/visit_steppers.hpp"

namespace jourdain::tests {
namespace {

using Long = long double;

/// All entries of y and z, at the ends of steps, where velocities have been brought back.
TEST(RollingSteps, HaveTheOrdersOfTheirMethods) {
  const auto sleigh = [](const std::string& name, int order, auto step, auto& history) {
    const auto start = sleigh_all::initial_state(sleigh_all::Model<Long>());
    const double measured = measured_order(start, sleigh_all::Input<Long>{}, 2, step, history);
    EXPECT_NEAR(measured, order, 0.1) << name;
  };
  JOURDAIN_VISIT_STEPPERS(sleigh_all, Long, sleigh);
}

/// With v forward and w: v^2 + k w^2 = V^2, k = (I + m d^2)/m, and v = V tanh(c (t - t0)), w = V sech(...)/sqrt(k),
/// c = d V/k: it ends up straight.
TEST(RollingSteps, SleighFollowsItsClosedForm) {
  const Long m = 5, d = 0.3L, k = (0.4L + m * d * d) / m;
  const sleigh_all::Model<double> model;
  auto state = sleigh_all::initial_state(model);
  const auto speeds = [&] {
    const Long angle = state.y[2];
    return std::pair(state.z[0] * std::cos(angle) + state.z[1] * std::sin(angle), Long(state.z[2]));
  };
  const auto [v0, w0] = speeds();
  const Long V = std::sqrt(v0 * v0 + k * w0 * w0), c = d * V / k, phase = std::atanh(v0 / V);
  double worst = 0;
  for (int i = 1; i <= 10000; ++i) {
    sleigh_all::rk4_step(model, state, {}, 1e-3);
    const Long at = c * i * 1e-3L + phase;
    const auto [v, w] = speeds();
    worst = std::max({worst, double(std::fabs(v - V * std::tanh(at))),
                      double(std::fabs(w - V / std::sqrt(k) / std::cosh(at)))});
  }
  fmt::print("sleigh: within {:.1e} m/s, rad/s of the closed form over 10 s of RK4 with 1 ms\n", worst);
  EXPECT_LE(worst, 1e-12);
  EXPECT_LE(std::fabs(state.z[2]), 0.01 * double(w0));
}

TEST(RollingSteps, DiscStaysOnThePlaneForAMillionSteps) {
#ifdef JOURDAIN_SANITIZED
  constexpr int kSteps = 10000;
#else
  constexpr int kSteps = 1000000;
#endif
  const rolling_disc_steps::Model<double> model;
  auto state = rolling_disc_steps::initial_state(model);
  const auto energy = [&] {
    return rolling_disc_steps::kinetic_energy(model, state) +
           rolling_disc_steps::potential_energy(model, state);
  };
  const double before = energy();
  double height = 0, slip = 0, way = 0, largest = 0;
  for (int i = 1; i <= kSteps; ++i) {
    rolling_disc_steps::rk4_step(model, state, {}, 1e-3);
    double g[3], rate[3];
    rolling_disc_steps::constraint_residual(model, state, g, rate);
    height = std::max(height, std::fabs(g[0]));
    for (const double r : rate) slip = std::max(slip, std::fabs(r));
    way += std::hypot(state.z[0], state.z[1]) * 1e-3;
    largest = std::max(largest, std::fabs(energy() - before));
  }
  fmt::print(
      "disc: {:.0f} m rolled, height within {:.1e} m, slip {:.1e} m/s, energy within {:.1e} of itself\n", way,
      height, slip, largest / before);
  EXPECT_LE(height, 1e-12);
  EXPECT_LE(slip, 1e-11);
  EXPECT_LE(largest, 1e-6 * before);
  EXPECT_GE(way, 1e-3 * kSteps);
}

}  // namespace
}  // namespace jourdain::tests
