// Time in float and double over many steps, angles that follow from it, and a driven motion long after its start.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shaking_cart_all/shaking_cart_all_kernels.hpp"

namespace jourdain::tests {
namespace {

using shaking_cart_all::Time;
using Angle = shaking_cart_all::detail::Angle<float>;
using Long = long double;

template <class Real>
Long value(const Time<Real>& t) {
  return static_cast<Long>(t.high) + static_cast<Long>(t.low) + static_cast<Long>(t.rest);
}
Long value(const Angle& a) { return static_cast<Long>(a.high) + static_cast<Long>(a.low); }

TEST(Clock, LosesNothingOfSteps) {
  constexpr float kStep =
      0.003F;  // 31 hours, where one float is rounded to 1/128 s and two still err by more than a step
  constexpr long kSteps = 37'500'000;
  Time<float> t;
  for (long i = 0; i < kSteps; ++i) t = t + kStep;
  EXPECT_EQ(value(t), kSteps * static_cast<Long>(kStep));
  EXPECT_EQ(static_cast<float>(t), static_cast<float>(kSteps * static_cast<double>(kStep)));
}

TEST(Clock, TakesStepsOfAllLengthsAndStartsAnewWhereItIsSet) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> length(-1e-3F, 4e-3F);
  Time<float> t = 20000.0F;
  Long exact = 20000;
  for (int i = 0; i < 1'000'000; ++i) {
    const float h = length(random);
    t += h;
    exact += static_cast<Long>(h);
  }
  EXPECT_NEAR(static_cast<double>(value(t) - exact), 0, 1e-9);
  t = 0.5F;
  EXPECT_EQ(value(t), 0.5L);
}

TEST(Clock, AnglesKeepTwiceTheDigits) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> number(0.5F, 2.0F);
  const auto pair = [&] { return Angle(number(random), 1e-9F * number(random)); };
  const Long unit = 0x1p-45L;
  for (int i = 0; i < 1000; ++i) {
    const Angle a = pair(), b = pair();
    EXPECT_NEAR(static_cast<double>(value(a + b) - (value(a) + value(b))), 0, static_cast<double>(4 * unit));
    EXPECT_NEAR(static_cast<double>(value(a - b) - (value(a) - value(b))), 0, static_cast<double>(4 * unit));
    EXPECT_NEAR(static_cast<double>(value(a * b) - value(a) * value(b)), 0, static_cast<double>(8 * unit));
    EXPECT_NEAR(static_cast<double>(value(a / b) - value(a) / value(b)), 0, static_cast<double>(16 * unit));
    const Angle turned = Angle(1e6F * number(random)) * Angle(number(random));
    float s = 0, c = 0;
    shaking_cart_all::detail::sine_cosine(turned, s, c);
    EXPECT_NEAR(s, static_cast<float>(std::sin(value(turned))), 3e-7F);
    EXPECT_NEAR(c, static_cast<float>(std::cos(value(turned))), 3e-7F);
    EXPECT_EQ(s, shaking_cart_all::detail::sine(turned));
    EXPECT_EQ(c, shaking_cart_all::detail::cosine(turned));
  }
}

/// The cart's steady motion in its base: m y'' + d y' + k y = m a r² sin(r t), by numbers of models/shaking_cart.toml.
struct Steady {
  Long m = 8, d = 15, k = 900, amplitude = 0.05F, rate = 12;

  Long at(Long t, bool velocity) const {
    const Long real = k - m * rate * rate, imaginary = d * rate;
    const Long force = m * amplitude * rate * rate, size = real * real + imaginary * imaginary;
    const Long sine = force * real / size, cosine = -force * imaginary / size;
    return velocity ? rate * (sine * std::cos(rate * t) - cosine * std::sin(rate * t))
                    : sine * std::sin(rate * t) + cosine * std::cos(rate * t);
  }
};

/// Largest error of the position within a period after t₀, as a share of the amplitude.
template <class Real>
double worst_in_a_period(double t0, Real h) {
  const shaking_cart_all::Model<Real> model;
  const Steady steady;
  shaking_cart_all::State<Real> state;
  state.t =
      Time<Real>(static_cast<Real>(t0), static_cast<Real>(t0 - static_cast<double>(static_cast<Real>(t0))));
  const Long start = value(state.t);
  state.y[0] = static_cast<Real>(steady.at(start, false));
  state.z[0] = static_cast<Real>(steady.at(start, true));
  double worst = 0;
  const long steps = std::lround(2 * M_PI / 12 / static_cast<double>(h));
  for (long i = 1; i <= steps; ++i) {
    rk4_step(model, state, {}, h);
    const Long exact = steady.at(start + static_cast<Long>(i) * static_cast<Long>(h), false);
    worst = std::max(worst, static_cast<double>(std::fabs(static_cast<Long>(state.y[0]) - exact)));
  }
  return worst /
         static_cast<double>(steady.m * steady.amplitude * 144 / std::hypot(900 - 8 * 144.0L, 180.0L));
}

TEST(Clock, DrivenMotionInFloatIsAsGoodAfterADay) {
  for (const float h : {1e-3F, 3e-3F}) {
    double first = 0, late = 0;
    for (int i = 0; i < 20; ++i) {
      first = std::max(first, worst_in_a_period<float>(1 + 0.013 * i, h));
      late = std::max(late, worst_in_a_period<float>(1e5 + 0.013 * i, h));
    }
    EXPECT_LT(late, 2 * first) << h;
    EXPECT_LT(first, 1e-5) << h;
  }
  EXPECT_LT(worst_in_a_period<double>(1e9, 1e-3), 2 * worst_in_a_period<double>(1, 1e-3));
}

}  // namespace
}  // namespace jourdain::tests
