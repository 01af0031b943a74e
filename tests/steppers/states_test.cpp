// States beside a mechanism: steps, linearisation and inertia of an arm with a motor, a controller and a filter, and of
// a quarter of a car with a tyre, against their equations written out; orders of every stepper, with loops too; what
// bristles hold.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "block_on_slope_steps/block_on_slope_steps_kernels.hpp"
#include "driven_four_bar_all/driven_four_bar_all_kernels.hpp"
#include "led_crank_all/led_crank_all_kernels.hpp"
#include "quarter_car_steps/quarter_car_steps_kernels.hpp"
#include "servo_arm_all/servo_arm_all_kernels.hpp"
#include "servo_arm_slow/servo_arm_slow_kernels.hpp"
#include "shaking_table_all/shaking_table_all_kernels.hpp"
#include "standing_quadruped_steps/standing_quadruped_steps_kernels.hpp"
#include "steppers/measured_order.hpp"
#include "steppers/visit_steppers.hpp"

namespace jourdain::tests {
namespace {

using Long = long double;

template <std::size_t n>
using Numbers = std::array<Long, n>;

/// Angle, rate, current, integral, filtered speed.
using Motion = Numbers<5>;

constexpr Long kTarget = -1.4L;  // near enough to the start for the voltage to stay within the supply

/// models/servo_arm.toml by hand.
struct ServoArm {
  Long R = 0.299, L = 0.082e-3, k = 30.2e-3, rotor = 1.42e-5, gear = 100, m = 2, l = 0.5, P = 80, I = 120,
       D = 8, T = 2e-3, supply = 24, g = 9.81;
  Long J = m * l * l + gear * gear * rotor;

  Motion rates(const Motion& x, Long target) const {
    const auto [q, w, i, integral, filtered] = x;
    const Long demand = P * (target - q) - D * filtered + integral;
    const Long voltage = std::max(-supply, std::min(supply, demand));
    return {w, (gear * k * i - m * g * l * std::cos(q)) / J, (voltage - R * i - k * gear * w) / L,
            std::fabs(demand) < supply ? I * (target - q) : 0, (w - filtered) / T};
  }
};

template <std::size_t n>
Numbers<n> along(Numbers<n> x, Long h, const Numbers<n>& rate) {
  for (std::size_t i = 0; i < n; ++i) x[i] += h * rate[i];
  return x;
}

template <std::size_t n, class Scene>
Numbers<n> rk4(const Scene& scene, const Numbers<n>& x, Long input, Long h) {
  const Numbers<n> k1 = scene.rates(x, input), k2 = scene.rates(along(x, h / 2, k1), input),
                   k3 = scene.rates(along(x, h / 2, k2), input), k4 = scene.rates(along(x, h, k3), input);
  Numbers<n> next = x;
  for (std::size_t i = 0; i < n; ++i) next[i] += h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]);
  return next;
}

template <class Real>
Motion motion_of(const servo_arm_all::State<Real>& state) {
  return {state.y[0], state.z[0], state.z[1], state.z[2], state.z[3]};
}

template <class Real>
servo_arm_all::Input<Real> told(Long target) {
  servo_arm_all::Input<Real> input{};
  input.u[0] = static_cast<Real>(target);
  return input;
}

/// Parameters are doubles in the description.
template <class Real>
servo_arm_all::Model<Real> exact_model() {
  const ServoArm arm;
  servo_arm_all::Parameters<Real> p;
  p.resistance = Real(arm.R);
  p.inductance = Real(arm.L);
  p.constant = Real(arm.k);
  p.rotor = Real(arm.rotor);
  p.T = Real(arm.T);
  return servo_arm_all::Model<Real>(p);
}

/// The same method twice: only rounding may differ, through a start of 24 V and the controller's return within it.
TEST(States, StepsOfAServoArmAreThoseOfItsEquations) {
  const ServoArm arm;
  const auto model = exact_model<Long>();
  for (const Long target : {kTarget, 0.3L}) {
    auto state = servo_arm_all::initial_state(model);
    Motion expected = motion_of(state);
    const Long h = 1e-4L;
    Long worst = 0, most = 0;
    for (int n = 0; n < 5000; ++n) {
      servo_arm_all::rk4_step(model, state, told<Long>(target), h);
      expected = rk4(arm, expected, target, h);
      const Motion found = motion_of(state);
      for (std::size_t i = 0; i < found.size(); ++i)
        worst = std::max(worst, std::fabs(found[i] - expected[i]) / (1 + std::fabs(expected[i])));
      most = std::max(most, std::fabs(expected[2]));
    }
    EXPECT_LE(worst, 1e-15L) << static_cast<double>(target);
    EXPECT_GE(most, target > 0 ? 20 : 5);  // A: the motor works
    EXPECT_NEAR(double(state.y[0]), double(target), 0.1);
  }
}

TEST(States, RestWhereTheMotorHoldsTheWeight) {
  const ServoArm arm;
  const auto model = exact_model<double>();
  auto state = servo_arm_all::initial_state(model);
  for (int n = 0; n < 120000; ++n) servo_arm_all::rk4_step(model, state, told<double>(0.3L), 1e-4);
  const double current = double(arm.m * arm.g * arm.l * std::cos(0.3L) / (arm.gear * arm.k));
  EXPECT_NEAR(state.y[0], 0.3, 1e-6);
  EXPECT_NEAR(state.z[1], current, 1e-5 * current);
  EXPECT_NEAR(state.z[2], double(arm.R) * current, 1e-4);
  EXPECT_NEAR(state.z[3], 0, 1e-6);
}

TEST(States, LinearizeHasARowAndAColumnForEachStateAndNoneForADisplacementOfIt) {
  const ServoArm a;
  const auto model = exact_model<Long>();
  auto state = servo_arm_all::initial_state(model);
  state.y[0] = 0.2L;
  state.z[1] = 3;
  servo_arm_all::Linearization<Long> result;
  servo_arm_all::linearize(model, state, told<Long>(0.25L), result);
  const Long expected[5][5] = {{0, 1, 0, 0, 0},
                               {a.m * a.g * a.l * std::sin(0.2L) / a.J, 0, a.gear * a.k / a.J, 0, 0},
                               {-a.P / a.L, -a.k * a.gear / a.L, -a.R / a.L, 1 / a.L, -a.D / a.L},
                               {-a.I, 0, 0, 0, 0},
                               {0, 1 / a.T, 0, 0, -1 / a.T}};
  const Long by_target[5] = {0, 0, a.P / a.L, a.I, 0};
  static_assert(sizeof result.A == sizeof expected);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j)
      EXPECT_NEAR(double(result.A[i][j]), double(expected[i][j]), 1e-12 * double(std::fabs(expected[i][j])))
          << i << " " << j;
    EXPECT_NEAR(double(result.B[i][0]), double(by_target[i]), 1e-12 * double(std::fabs(by_target[i]))) << i;
  }
}

TEST(States, HaveUnitInertiaAndNoEnergy) {
  const ServoArm arm;
  const auto model = exact_model<double>();
  auto state = servo_arm_all::initial_state(model);
  state.z[0] = 2;
  for (int i = 1; i < 4; ++i) state.z[i] = 5;
  EXPECT_NEAR(servo_arm_all::kinetic_energy(model, state), double(arm.J) * 2, 1e-12);
  double M[4][4];
  servo_arm_all::mass_matrix(model, state, M);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) EXPECT_EQ(M[i][j], i != j ? 0 : i == 0 ? M[0][0] : 1) << i << " " << j;
  EXPECT_NEAR(M[0][0], double(arm.J), 1e-15);
  double zdot[4], tau[4];
  servo_arm_all::forward_dynamics(model, state, told<double>(0), zdot);
  servo_arm_all::inverse_dynamics(model, state, zdot, tau);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(tau[i], 0, 1e-9 * (1 + std::fabs(zdot[i]))) << i;
}

/// models/quarter_car.toml by hand: way, heave, travel, spin, their rates, slip.
struct QuarterCar {
  Long car = 300, hub = 25, wheel = 15, inertia = 1, g = 9.81, spring = 2e4, damper = 1.5e3, preload = 2943,
       stiffness = 2e5, damping = 100, radius = 0.32, relaxation = 0.3, B = 10, C = 1.9, E = 0.97,
       bump = 0.05, place = 10, width = 0.4;

  Numbers<9> rates(const Numbers<9>& x, Long torque) const {
    const auto [way, heave, travel, spin, v, up, rise, turn, slip] = x;
    const Long road = bump * std::exp(-((way - place) / width) * ((way - place) / width));
    const Long slope = -2 * (way - place) / (width * width) * road;
    const Long d = radius + road - (heave + travel);
    const Long load = d > 0 ? std::max(stiffness * d + damping * (slope * v - (up + rise)), 0.0L) : 0;
    const Long traction = load * std::sin(C * std::atan(B * slip - E * (B * slip - std::atan(B * slip))));
    const Long between = -spring * travel - preload - damper * rise;  // on the hub, up
    const Long a_car = -between / car - g, a_wheel = (between + load) / (hub + wheel) - g;
    return {v,
            up,
            rise,
            turn,
            (traction - slope * load) / (car + hub + wheel),
            a_car,
            a_wheel - a_car,
            (torque - radius * traction) / inertia,
            (radius * turn - v - std::fabs(v) * slip) / relaxation};
  }
};

/// models/shaking_table.toml by hand: ways of the floors, their rates, place and speed of the table.
struct ShakingTable {
  Long w = 40, d = 0.8, m = 12, k = 9e3, c = 6, table = 80;

  Long table_acceleration(const Numbers<6>& x, Long command) const {
    return w * w * (command - x[4]) - 2 * d * w * x[5];
  }
  Numbers<6> rates(const Numbers<6>& x, Long command) const {
    const auto [lower, upper, lower_rate, upper_rate, place, speed] = x;
    const Long a = table_acceleration(x, command);
    const Long on_lower = -k * lower - c * lower_rate, on_upper = -k * upper - c * upper_rate;
    const Long first = (on_lower - on_upper) / m, second = on_upper / m;  // of the floors
    return {lower_rate, upper_rate, first - a, second - first, speed, a};
  }
};

/// The command jumps every tenth of a second: the table's acceleration does, its place and speed do not.
TEST(States, StepsOfABuildingOnATableThatStatesLeadAreThoseOfItsEquations) {
  const ShakingTable by_hand;
  shaking_table_all::Parameters<Long> p;
  p.d = by_hand.d;
  const shaking_table_all::Model<Long> model(p);
  auto state = shaking_table_all::initial_state(model);
  Numbers<6> expected{};
  Long worst = 0, drives = 0, most = 0;
  for (int n = 0; n < 2000; ++n) {
    shaking_table_all::Input<Long> input{};
    input.u[0] = 0.05L * std::sin(3.0L * static_cast<Long>(n / 100));
    shaking_table_all::rk4_step(model, state, input, 1e-3L);
    expected = rk4(by_hand, expected, input.u[0], 1e-3L);
    for (std::size_t i = 0; i < 6; ++i) {
      const Long found = i < 2 ? state.y[i] : state.z[i - 2];
      worst = std::max(worst, std::fabs(found - expected[i]) / (1 + std::fabs(expected[i])));
    }
    shaking_table_all::Outputs<Long> outputs;
    shaking_table_all::outputs(model, state, input, outputs);
    const Numbers<6> rates = by_hand.rates(expected, input.u[0]);
    const Long drive = by_hand.table * rates[5] + by_hand.m * (2 * (rates[5] + rates[2]) + rates[3]);
    drives = std::max(drives, std::fabs(outputs.drive - drive) / (1 + std::fabs(drive)));
    most = std::max(most, std::fabs(drive));
  }
  EXPECT_LE(worst, 1e-15L);
  EXPECT_LE(drives, 1e-14L);
  EXPECT_GE(most, 1000);  // N
}

/// Of k_bar, which takes inputs here, of inverse dynamics and of the implicit steps' Jacobian.
TEST(States, ThatLeadAMotionAreInEveryFunction) {
  const ShakingTable by_hand;
  shaking_table_all::Parameters<Long> p;
  p.d = by_hand.d;
  const shaking_table_all::Model<Long> model(p);
  auto state = shaking_table_all::initial_state(model);
  for (int i = 0; i < 2; ++i) state.y[i] = 0.01L * (i + 1);
  for (int i = 0; i < 4; ++i) state.z[i] = 0.3L - 0.1L * i;
  shaking_table_all::Input<Long> input{};
  input.u[0] = 0.02L;
  Long k[4], q[4], zdot[4], tau[4];
  shaking_table_all::k_bar(model, state, input, k);
  shaking_table_all::q_bar(model, state, input, q);
  const Long a = by_hand.table_acceleration({0, 0, 0, 0, state.z[2], state.z[3]}, 0.02L);
  EXPECT_NEAR(double(k[0]), double(-2 * by_hand.m * a), 1e-13 * std::fabs(double(k[0])));
  EXPECT_NEAR(double(k[1]), double(-by_hand.m * a), 1e-13 * std::fabs(double(k[1])));
  shaking_table_all::forward_dynamics(model, state, input, zdot);
  shaking_table_all::inverse_dynamics(model, state, input, zdot, tau);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(double(tau[i]), 0, 1e-13) << i;
  shaking_table_all::Linearization<Long> at;
  shaking_table_all::linearize(model, state, input, at);
  EXPECT_NEAR(double(at.A[2][4]), double(by_hand.w * by_hand.w),
              1e-9);  // of the lower floor by the table's place
  EXPECT_NEAR(double(at.B[2][0]), double(-by_hand.w * by_hand.w), 1e-9);
  EXPECT_NEAR(double(at.A[3][4]), 0, 1e-9);
}

/// tests/steppers/led_crank.toml: w = u (1 - exp(-5 t)), and the piston where crank and rod put it; what the crank is
/// turned with gives the energy.
TEST(States, ACrankThatStatesLeadGoesAsTheClosedFormSays) {
  const led_crank_all::Model<Long> model;
  auto state = led_crank_all::initial_state(model);
  led_crank_all::Input<Long> input{};
  input.u[0] = 20;
  const Long h = 1e-4L, start = 0.3L;
  const auto power = [&] {
    led_crank_all::Outputs<Long> outputs;
    led_crank_all::outputs(model, state, input, outputs);
    return outputs.drive * state.z[3];
  };
  const auto energy = [&] {
    return led_crank_all::kinetic_energy(model, state) + led_crank_all::potential_energy(model, state);
  };
  Long worst = 0, open = 0, work = 0;
  const Long before = energy();
  for (int n = 1; n <= 20000; ++n) {
    const Long first = power();
    led_crank_all::rk4_step(model, state, input, h / 2);
    const Long middle = power();
    led_crank_all::rk4_step(model, state, input, h / 2);
    work += h / 6 * (first + 4 * middle + power());
    const Long t = n * h, angle = start + 20 * t - 4 * (1 - std::exp(-5 * t));
    const Long sine = std::sin(angle),
               bore = 0.1L * std::cos(angle) + std::sqrt(0.36L - 0.01L * sine * sine) - 0.6L;
    worst = std::max(worst, std::fabs(state.y[1] - bore));
    Long g[2], rate[2];
    led_crank_all::constraint_residual(model, state, g, rate);
    for (int k = 0; k < 2; ++k) open = std::max({open, std::fabs(g[k]), std::fabs(rate[k])});
  }
  EXPECT_LE(worst, 1e-14L);
  EXPECT_LE(open, 1e-15L);
  EXPECT_LE(std::fabs(energy() - before - work), 1e-10L);
  EXPECT_GE(std::fabs(energy() - before), 1);
}

/// Over the bump and beyond, braking to a locked wheel and driving: the wheel leaves the ground and comes back.
TEST(States, StepsOfAQuarterCarAreThoseOfItsEquations) {
  const QuarterCar car;
  quarter_car_steps::Parameters<Long> p;
  p.radius = car.radius;
  p.relaxation = car.relaxation;
  p.C = car.C;
  p.E = car.E;
  p.bump = car.bump;
  p.width = car.width;
  const quarter_car_steps::Model<Long> model(p);
  for (const Long torque : {-1500.0L, 0.0L, 800.0L}) {
    auto state = quarter_car_steps::initial_state(model);
    const auto numbers = [&state] {
      Numbers<9> x;
      std::copy(std::begin(state.y), std::end(state.y), x.begin());
      std::copy(std::begin(state.z), std::end(state.z), x.begin() + 4);
      return x;
    };
    Numbers<9> expected = numbers();
    quarter_car_steps::Input<Long> input{};
    input.u[0] = torque;
    Long worst = 0;
    bool flew = false;
    for (int n = 0; n < 1000; ++n) {
      quarter_car_steps::rk4_step(model, state, input, 1e-3L);
      expected = rk4(car, expected, torque, 1e-3L);
      const Numbers<9> found = numbers();
      for (std::size_t i = 0; i < found.size(); ++i)
        worst = std::max(worst, std::fabs(found[i] - expected[i]) / (1 + std::fabs(expected[i])));
      quarter_car_steps::Outputs<Long> outputs;
      quarter_car_steps::outputs(model, state, input, outputs);
      flew = flew || outputs.wheel_load == 0;
    }
    EXPECT_LE(worst, 1e-14L) << static_cast<double>(torque);
    EXPECT_TRUE(flew);
    EXPECT_EQ(double(state.z[3]) < 1, torque < 0) << "locked";
  }
}

/// LuGre friction against what a block weighs along its slope: below the cone it creeps with the speed of its
/// smoothing, far below the 1e-6 m/s that are asked for; above it slides as Coulomb says.
TEST(States, ABlockWithBristlesStandsStillOnASlope) {
  const auto after = [](double slope, double duration) {
    block_on_slope_steps::Parameters<double> p;
    p.slope = slope;
    const block_on_slope_steps::Model<double> model(p);
    auto state = block_on_slope_steps::initial_state(model);
    const double h = 1e-4;
    for (int n = 0; n < int(std::lround(duration / h)); ++n)
      block_on_slope_steps::rk4_step(model, state, {}, h);
    return state;
  };
  const double slope = std::acos(-1.0) / 9;
  const auto early = after(slope, 1), late = after(slope, 2);
  const double creep = 1e-8 * std::tan(slope) / std::sqrt(0.25 - std::tan(slope) * std::tan(slope));
  EXPECT_NEAR(early.y[0] - late.y[0], creep, 1e-3 * creep);
  for (int k = 1; k < 3; ++k) EXPECT_NEAR(late.y[k], early.y[k], 1e-12) << k;
  EXPECT_NEAR(-late.z[6], std::tan(slope) / 1e4, 0.05 * std::tan(slope) / 1e4);  // a bristle's deflection
  const double steep = std::acos(-1.0) / 6, pull = std::sin(steep) - 0.5 * std::cos(steep);
  const auto sliding = after(steep, 0.5), later = after(steep, 0.6);
  EXPECT_NEAR((later.z[0] - sliding.z[0]) / 0.1, -9.81 * pull, 1e-3);
}

TEST(States, AQuadrupedStands) {
  const standing_quadruped_steps::Model<double> model;
  auto state = standing_quadruped_steps::initial_state(model);
  for (int n = 0; n < 20000; ++n) standing_quadruped_steps::rk4_step(model, state, {}, 2.5e-4);
  const auto early = state;
  for (int n = 0; n < 4000; ++n) standing_quadruped_steps::rk4_step(model, state, {}, 2.5e-4);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(state.y[k], early.y[k], 1e-6) << k;  // within a second
  EXPECT_NEAR(state.y[2], 0.3, 0.02);
}

/// All entries of y and z: states are integrated with the order of the rest.
TEST(States, EveryStepperHasItsOrder) {
  const auto arm = [](const std::string& name, int order, auto step, auto& history) {
    const auto start = servo_arm_slow::initial_state(servo_arm_slow::Model<Long>());
    servo_arm_slow::Input<Long> input{};
    input.u[0] = kTarget;
    EXPECT_NEAR(measured_order(start, input, 0.1L, step, history), order, 0.1) << "servo_arm " << name;
  };
  JOURDAIN_VISIT_STEPPERS(servo_arm_slow, Long, arm);
  const auto linkage = [](const std::string& name, int order, auto step, auto& history) {
    const auto start = driven_four_bar_all::initial_state(driven_four_bar_all::Model<Long>());
    const double measured = measured_order(start, driven_four_bar_all::Input<Long>{}, 1, step, history);
    EXPECT_NEAR(measured, order, 0.1) << "driven_four_bar " << name;
  };
  JOURDAIN_VISIT_STEPPERS(driven_four_bar_all, Long, linkage);
  const auto crank = [](const std::string& name, int order, auto step, auto& history) {
    const auto start = led_crank_all::initial_state(led_crank_all::Model<Long>());
    led_crank_all::Input<Long> input{};
    input.u[0] = 5;
    EXPECT_NEAR(measured_order(start, input, 1, step, history), order, 0.15) << "led_crank " << name;
  };
  JOURDAIN_VISIT_STEPPERS(led_crank_all, Long, crank);
  const auto building = [](const std::string& name, int order, auto step, auto& history) {
    const auto start = shaking_table_all::initial_state(shaking_table_all::Model<Long>());
    shaking_table_all::Input<Long> input{};
    input.u[0] = 0.05L;
    EXPECT_NEAR(measured_order(start, input, 0.05L, step, history), order, 0.15) << "shaking_table " << name;
  };
  JOURDAIN_VISIT_STEPPERS(shaking_table_all, Long, building);
}

}  // namespace
}  // namespace jourdain::tests
