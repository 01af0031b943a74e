// Steps of what rolls and glides without slip: orders of every stepper, a sleigh along its closed form, a disc for a
// million steps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "rolling_disc_steps/rolling_disc_steps_kernels.hpp"
#include "rolling_hills_steps/rolling_hills_steps_kernels.hpp"
#include "sleigh_all/sleigh_all_kernels.hpp"
#include "steppers/measured_order.hpp"
#include "steppers/visit_steppers.hpp"
#include "tethered_robot_all/tethered_robot_all_kernels.hpp"

namespace jourdain::tests {
namespace {

using Long = long double;

/// All entries of y and z, at the ends of steps, where velocities have been brought back. Between 4.5, where steps are
/// long, and rounding (1e-18 of 7e-17) the fifth order is seen to 0.15.
TEST(RollingSteps, HaveTheOrdersOfTheirMethods) {
  const auto sleigh = [](const std::string& name, int order, auto step, auto& history) {
    const auto start = sleigh_all::initial_state(sleigh_all::Model<Long>());
    const double measured = measured_order(start, sleigh_all::Input<Long>{}, 2, step, history);
    EXPECT_NEAR(measured, order, order < 5 ? 0.1 : 0.15) << name;
  };
  JOURDAIN_VISIT_STEPPERS(sleigh_all, Long, sleigh);
}

/// A W-method of the step: what is carried along is explicit. Loops are closed beside it.
template <class Step>
double order_with_carried_positions(const Step& step) {
  using namespace tethered_robot_all;
  const Model<Long> model;
  Accelerations<Long> accelerations;
  const auto stepped = [&](auto& state, const auto& input, Long h, auto& history) {
    step(model, state, input, h, history);
  };
  return measured_order(initial_state(model), Input<Long>{}, 1, stepped, accelerations);
}

TEST(RollingSteps, HaveTheOrdersOfWMethodsWithWhatIsCarriedAlong) {
  using namespace tethered_robot_all;
  EXPECT_NEAR(order_with_carried_positions([](auto&... a) { linearly_implicit_euler_step(a...); }), 1, 0.1);
  EXPECT_NEAR(order_with_carried_positions([](auto&... a) { ros34pw2_step(a...); }), 3, 0.1);
  const double rosw43 = order_with_carried_positions([](auto&... a) { rosw43_step(a...); });
  fmt::print("rosw43 with positions that are carried along: order {:.2f}\n", rosw43);
  EXPECT_GE(rosw43, 2.9);
}

/// A drive of 3590 /s on what rolls: RK4 with steps of 2 ms is gone after some.
TEST(RollingSteps, StiffDrivesDoNotLimitWMethodsWithWhatIsCarriedAlong) {
  using namespace tethered_robot_all;
  Parameters<double> parameters;
  parameters.drag = 20;
  const Model<double> model(parameters);
  auto fine = initial_state(model), coarse = fine, lost = fine;
  Accelerations<double> accelerations;
  for (int i = 0; i < 20000; ++i) rk4_step(model, fine, {}, 1e-4);
  for (int i = 0; i < 1000; ++i) {
    rosw43_step(model, coarse, {}, 2e-3, accelerations);
    rk4_step(model, lost, {}, 2e-3);
  }
  double apart = 0;
  for (std::size_t i = 0; i < std::size(fine.y); ++i)
    apart = std::max(apart, std::fabs(fine.y[i] - coarse.y[i]));
  fmt::print("tethered robot: rosw43 with 2 ms within {:.1e} rad, m after 2 s\n", apart);
  EXPECT_LE(apart, 0.05);
  EXPECT_FALSE(std::fabs(lost.z[2]) < 1e3);
}

/// As the page of loops says: 65 ms over a second, until a velocity is ten times the largest of the motion.
TEST(RollingSteps, StepsOfWMethodsHoldFarBeyondTheStiffDrive) {
  using namespace tethered_robot_all;
  Parameters<double> parameters;
  parameters.drag = 20;
  const Model<double> model(parameters);
  const auto fastest = [&](int steps, double h, const auto& step) {
    auto state = initial_state(model);
    Accelerations<double> accelerations;
    const Input<double> input;
    double largest = 0;
    for (int i = 0; i < steps; ++i) {
      step(model, state, input, h, accelerations);
      for (const double z : state.z) largest = std::isfinite(z) ? std::max(largest, std::fabs(z)) : INFINITY;
    }
    return largest;
  };
  const double usual = fastest(10000, 1e-4, [](auto& of, auto& state, const auto& input, double h, auto&) {
    rk4_step(of, state, input, h);
  });
  EXPECT_LE(fastest(15, 0.065, [](auto&... a) { linearly_implicit_euler_step(a...); }), 10 * usual);
  EXPECT_LE(fastest(15, 0.065, [](auto&... a) { ros34pw2_step(a...); }), 10 * usual);
  EXPECT_LE(fastest(15, 0.065, [](auto&... a) { rosw43_step(a...); }), 10 * usual);
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

/// Of RK4 steps of 1 ms, what is left open and how far the energy goes.
template <class Model, class State, class Step, class Residual, class Energy>
void expect_kept(const char* name, const Model& model, State state, int steps, const Step& step,
                 const Residual& residual, const Energy& energy) {
  const double before = energy(model, state);
  double height = 0, slip = 0, way = 0, largest = 0;
  for (int i = 1; i <= steps; ++i) {
    step(model, state);
    double g[3], rate[3];
    residual(model, state, g, rate);
    height = std::max(height, std::fabs(g[0]));
    for (const double r : rate) slip = std::max(slip, std::fabs(r));
    way += std::hypot(state.z[0], state.z[1]) * 1e-3;
    largest = std::max(largest, std::fabs(energy(model, state) - before));
  }
  fmt::print("{}: {:.0f} m rolled, height within {:.1e} m, slip {:.1e} m/s, energy within {:.1e} of itself\n",
             name, way, height, slip, largest / before);
  EXPECT_LE(height, 1e-12);
  EXPECT_LE(slip, 1e-11);
  EXPECT_LE(largest, 1e-6 * before);
  EXPECT_GE(way, 1e-3 * steps);
}

#define JOURDAIN_EXPECT_KEPT(model, steps)                                                 \
  expect_kept(                                                                             \
      #model, model::Model<double>(), model::initial_state(model::Model<double>()), steps, \
      [](const auto& of, auto& state) { model::rk4_step(of, state, {}, 1e-3); },           \
      [](const auto& of, const auto& state, auto& g, auto& rate) {                         \
        model::constraint_residual(of, state, g, rate);                                    \
      },                                                                                   \
      [](const auto& of, const auto& state) {                                              \
        return model::kinetic_energy(of, state) + model::potential_energy(of, state);      \
      })

#ifdef JOURDAIN_SANITIZED
constexpr int kManySteps = 10000;
#else
constexpr int kManySteps = 1000000;
#endif

TEST(RollingSteps, DiscStaysOnThePlaneForAMillionSteps) {
  JOURDAIN_EXPECT_KEPT(rolling_disc_steps, kManySteps);
}

TEST(RollingSteps, DiscStaysOnHillsForAMillionSteps) {
  JOURDAIN_EXPECT_KEPT(rolling_hills_steps, kManySteps);
}

}  // namespace
}  // namespace jourdain::tests
