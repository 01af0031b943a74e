// Memories: steps of bodies that sampled laws push against the closed form between samples, of an arm with a digital
// controller against its equations written out, every stepper's order where steps divide the period, and number types.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "digital_servo_steps/digital_servo_steps_kernels.hpp"
#include "sampled_bodies_all/sampled_bodies_all_kernels.hpp"
#include "steppers/measured_order.hpp"
#include "steppers/visit_steppers.hpp"

namespace jourdain::tests {
namespace {

using Long = long double;

constexpr Long kWind = 1.25L;

template <class Real>
sampled_bodies_all::Input<Real> wind() {
  sampled_bodies_all::Input<Real> input{};
  input.u[0] = static_cast<Real>(kWind);
  return input;
}

/// The block under a force that is constant between samples.
struct Block {
  Long x = 0.4L, v = -0.3L, late = 0.7L, push = 0.7L;

  void sample() {
    const Long computed = kWind - 30 * x - 9 * v;
    push = late;
    late = computed;
  }
  void move(Long h) {
    const Long a = push / 2;
    x += h * (v + h * a / 2);
    v += h * a;
  }
};

/// Methods of order two and more are exact in between: whatever the steps, the block is where the closed form has it.
TEST(Memories, HoldAForceBetweenSamples) {
  const Long period = 0.025L;
  for (const int steps : {1, 2, 5, 8}) {
    const auto follow = [&](const std::string& name, int order, auto step, auto history) {
      if (order < 2) return;
      auto state = initial_state(sampled_bodies_all::Model<Long>());
      Block block;
      for (int n = 0; n < 200; ++n) {
        block.sample();
        block.move(period);
        for (int k = 0; k < steps; ++k) step(state, wind<Long>(), period / steps, history);
        ASSERT_NEAR(double(state.y[0]), double(block.x), 1e-15) << name << " " << steps << " " << n;
        ASSERT_NEAR(double(state.z[0]), double(block.v), 1e-15) << name << " " << steps << " " << n;
        ASSERT_NEAR(double(state.z[sampled_bodies_all::index::z_push]), double(block.push), 1e-14)
            << name << n;
      }
    };
    JOURDAIN_VISIT_ONE_STEP_METHODS(sampled_bodies_all, Long, follow);
  }
}

TEST(Memories, EveryStepperHasItsOrderBetweenSamples) {
  const auto bodies = [](const std::string& name, int order, auto step, auto& history) {
    const auto start = initial_state(sampled_bodies_all::Model<Long>());
    EXPECT_NEAR(measured_order(start, wind<Long>(), 5, step, history), order, 0.1) << name;
  };
  JOURDAIN_VISIT_ONE_STEP_METHODS(sampled_bodies_all, Long, bodies);
}

/// Inputs that are a function of the state are sampled at the start of the step, as laws are.
TEST(Memories, SampleInputsThatAreFunctions) {
  const sampled_bodies_all::Model<double> model;
  auto held = initial_state(model), sampled = held;
  for (int n = 0; n < 500; ++n) {
    sampled_bodies_all::Input<double> input{};
    input.u[0] = std::sin(double(held.t));
    rk4_step(model, held, input, 0.005);
    rk4_step(
        model, sampled,
        [](const auto& state) {
          sampled_bodies_all::Input<double> at{};
          at.u[0] = std::sin(double(state.t));
          return at;
        },
        0.005);
    for (int i = 0; i < decltype(model)::velocity_count; ++i)
      ASSERT_EQ(held.z[i], sampled.z[i]) << n << " " << i;
  }
}

/// A million samples in float: their times do not move off, though 0.025 s and its fifth are no binary numbers.
TEST(Memories, KeepTheirTimesInFloat) {
  const sampled_bodies_all::Model<float> model;
  auto state = initial_state(model);
  sampled_bodies_all::Input<float> input{};
  int samples = 0;
  for (int n = 0; n < 5000000; ++n) {
    input.u[0] =
        static_cast<float>(n % 5 == 0 ? 1 : 1000000);  // seen at other steps, it would throw the block away
    sampled_bodies_all::sample(model, state, input, 0.005F);
    state.y[0] = state.z[0] = 0;
    const bool is_sample = state.z[sampled_bodies_all::index::z_push_timer] > 0.0175F;
    ASSERT_EQ(is_sample, n % 5 == 0) << n;
    samples += is_sample;
    ASSERT_LE(state.z[sampled_bodies_all::index::z_push], 1) << n;
  }
  EXPECT_EQ(samples, 1000000);
}

/// models/digital_servo.toml by hand.
struct DigitalServo {
  Long m = 2, l = 0.3, P = 60, I = 90, D = 6, limit = 12, T = 5e-3, g = 9.81, inertia = 4 * m * l * l / 3;
  Long q = -std::acos(-1.0L) / 6, w = 0, last = q, integral = 0, late = 0, torque = 0;

  void sample(Long target) {
    const Long lines = 20000 / (2 * std::acos(-1.0L)), reading = std::floor(q * lines) / lines;
    const Long demand = P * (target - reading) - D * (reading - last) / T + integral;
    torque = late;
    late = std::max(std::min(demand, limit), -limit);
    if (std::fabs(demand) < limit) integral += I * T * (target - reading);
    last = reading;
  }
  std::array<Long, 2> rates(Long angle, Long rate) const {
    return {rate, (torque - m * g * l * std::cos(angle)) / inertia};
  }
  void step(Long h) {
    const auto [q1, w1] = rates(q, w);
    const auto [q2, w2] = rates(q + h / 2 * q1, w + h / 2 * w1);
    const auto [q3, w3] = rates(q + h / 2 * q2, w + h / 2 * w2);
    const auto [q4, w4] = rates(q + h * q3, w + h * w3);
    q += h / 6 * (q1 + 2 * (q2 + q3) + q4);
    w += h / 6 * (w1 + 2 * (w2 + w3) + w4);
  }
};

/// Through the limit of the torque and to where the integral holds the weight.
TEST(Memories, StepsOfADigitalServoAreThoseOfItsEquations) {
  DigitalServo servo;
  digital_servo_steps::Parameters<Long> p;
  p.half_length = servo.l;
  p.sampling = servo.T;
  const digital_servo_steps::Model<Long> model(p);
  auto state = initial_state(model);
  servo.q = servo.last = state.y[0];
  const Long target = 0.3L, h = 1e-3L;
  digital_servo_steps::Input<Long> input{};
  input.u[0] = target;
  Long worst = 0, most = 0;
  for (int n = 0; n < 4000; ++n) {
    if (n % 5 == 0) servo.sample(target);
    servo.step(h);
    rk4_step(model, state, input, h);
    using namespace digital_servo_steps::index;
    const Long found[] = {state.y[0], state.z[0], state.z[z_last_reading], state.z[z_integral],
                          state.z[z_torque]};
    const Long expected[] = {servo.q, servo.w, servo.last, servo.integral, servo.torque};
    for (int i = 0; i < 5; ++i) worst = std::max(worst, std::fabs(found[i] - expected[i]));
    most = std::max(most, std::fabs(servo.torque));
  }
  EXPECT_LE(
      worst,
      1e-9L);  // the encoder passes no small differences on, which grow as the arm would fall: by e^(2.7 t)
  EXPECT_EQ(double(most), 12);
  EXPECT_NEAR(double(state.y[0]), 0.3, 1e-3);
  EXPECT_NEAR(double(servo.integral), double(servo.m * servo.g * servo.l) * std::cos(0.3), 0.1);
}

}  // namespace
}  // namespace jourdain::tests
