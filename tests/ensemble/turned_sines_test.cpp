// Sines that the stages of a step turn, alone and in the steps of ensembles.
#include "jourdain/turned_sines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "cart_pole_ensemble/cart_pole_ensemble_kernels.hpp"
#include "cart_stops_packs/cart_stops_packs_kernels.hpp"
#include "crane_packs/crane_packs_kernels.hpp"
#include "double_pendulum_packs/double_pendulum_packs_kernels.hpp"
#include "four_bar_packs/four_bar_packs_kernels.hpp"
#include "jourdain/ensemble.hpp"
#include "panda_packs/panda_packs_kernels.hpp"
#include "quadrotor_packs/quadrotor_packs_kernels.hpp"
#include "quadruped_packs/quadruped_packs_kernels.hpp"
#include "states.hpp"

namespace jourdain::tests {
namespace {

template <class Real, std::size_t lanes>
using Turning = Pack<Real, lanes, TurnedSines>;

/// Sines and cosines of two stages: of x, and of x + change.
template <class Real, std::size_t lanes>
struct TwoStages {
  Turning<Real, lanes> first_sine, first_cosine, sine, cosine;

  TwoStages(const Turning<Real, lanes>& x, const Turning<Real, lanes>& then) {
    TurnedSines::Stages<Turning<Real, lanes>> stages(1, 2);
    sine_cosine(x, first_sine, first_cosine);
    sine_cosine(then, sine, cosine);
  }
};

/// The most that turned sines and cosines are off.
template <class Real>
double worst_error(double largest_angle) {
  double worst = 0;
  for (std::uint64_t i = 0; i < 50000; ++i) {
    Turning<Real, 4> x, then;
    for (std::size_t k = 0; k < 4; ++k) {
      x.set(k, static_cast<Real>(largest_angle * (2 * uniform(1, i, k) - 1)));
      then.set(k, static_cast<Real>(x[k] + static_cast<Real>(0.125 * (2 * uniform(2, i, k) - 1) * 0.9999)));
    }
    const TwoStages<Real, 4> turned(x, then);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto exact = static_cast<long double>(then[k]);
      worst = std::fmax(worst, static_cast<double>(std::fabs(turned.sine[k] - std::sin(exact))));
      worst = std::fmax(worst, static_cast<double>(std::fabs(turned.cosine[k] - std::cos(exact))));
    }
  }
  return worst;
}

TEST(TurnedSines, AreOffByRoundingAlone) {
  for (const double largest : {0.05, 3.0, 1e3, 1e6}) {
    EXPECT_LE(worst_error<double>(largest), 1.7e-16) << largest;  // as the page says
    EXPECT_GE(worst_error<double>(largest), 5e-17) << largest;
  }
  for (const double largest : {0.05, 3.0, 1e3}) {
    EXPECT_LE(worst_error<float>(largest), 7.5e-8) << largest;
    EXPECT_GE(worst_error<float>(largest), 3e-8) << largest;
  }
}

TEST(TurnedSines, AreComputedWhereAnglesHaveChangedMuch) {
  using Number = Turning<double, 4>;
  const double far = 0.125 + 0x1p-51, none = std::numeric_limits<double>::quiet_NaN();
  for (const double change : {far, -far, 0.3, 1e9, 1e300, none}) {
    const Number x(1.0);
    Number then(1.125);
    then.set(2, 1.0 + change);
    const TwoStages<double, 4> turned(x, then), all_near(x, Number(1.125));
    const Pack<double, 4> plain(then[2]);
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    EXPECT_TRUE(same(turned.sine[2], sin(plain)[2])) << change;
    EXPECT_TRUE(same(turned.cosine[2], cos(plain)[2])) << change;
    for (const std::size_t k : {std::size_t(0), std::size_t(1), std::size_t(3)}) {
      EXPECT_EQ(turned.sine[k], all_near.sine[k]);
      EXPECT_EQ(turned.cosine[k], all_near.cosine[k]);
    }
  }
}

/// How many of a stage's sines have not the bits of computed ones.
std::size_t turned_count(std::size_t angles) {
  using Number = Turning<double, 2>;
  TurnedSines::Stages<Number> stages(angles, 3);
  std::size_t turned = 0;
  for (int stage = 0; stage < 3; ++stage) {
    for (std::size_t i = 0; i < angles; ++i) {
      const Number x(0.37 * static_cast<double>(i) + 0.01 * stage);
      Number s, c;
      sine_cosine(x, s, c);
      Pack<double, 2> plain(x[0]), sine, cosine;
      sine_cosine(plain, sine, cosine);
      const bool differs = s[0] != sine[0] || c[0] != cosine[0];
      if (stage == 0 || i >= TurnedSines::most) {
        EXPECT_FALSE(differs) << stage << " " << i;
      }
      turned += differs;
    }
  }
  return turned;
}

TEST(TurnedSines, AreOfAsManyAnglesAsAreKept) {
  EXPECT_GT(turned_count(TurnedSines::most), 20u);
  EXPECT_GE(turned_count(2 * TurnedSines::most), turned_count(TurnedSines::most));
}

TEST(TurnedSines, OutsideOfStepsAreComputed) {
  const Turning<double, 2> x(0.7);
  const Pack<double, 2> plain(0.7);
  EXPECT_EQ(sin(x)[0], sin(plain)[0]);
  EXPECT_EQ(cos(x)[1], cos(plain)[1]);
}

template <template <class> class Model, class Real>
using Turned = Ensemble<Model, Real, 4, TurnedSines>;

/// Steps against those of ensembles that compute all sines: they differ, by rounding.
template <class Many, class Plain, class Stepper>
void expect_rounding(const Stepper& stepper, double tolerance) {
  using Real = typename Many::Model::Scalar;
  Many turned = started<Many>();
  Plain plain = started<Plain>();
  turned.run(stepper, static_cast<Real>(kStep), 60);
  plain.run(stepper, static_cast<Real>(kStep), 60);
  double apart = 0;
  for (std::size_t k = 0; k < kCount; ++k) {
    apart = std::fmax(apart, difference(turned.state(k), plain.state(k)));
    EXPECT_TRUE(turned.trusted(k)) << k;
  }
  EXPECT_LE(apart, tolerance);
  EXPECT_GT(apart, 0);
}

template <template <class> class Model>
void expect_rounding_of() {
  expect_rounding<Turned<Model, double>, Ensemble<Model, double, 4>>(rk4, 1e-12);
  expect_rounding<Turned<Model, float>, Ensemble<Model, float, 4>>(rk4, 1e-4);
}

TEST(TurnedSines, StepModelsOfAllKinds) {
  expect_rounding_of<panda_packs::Model>();
  expect_rounding_of<double_pendulum_packs::Model>();
  expect_rounding_of<cart_pole_ensemble::Model>();
  expect_rounding_of<quadruped_packs::Model>();
  expect_rounding_of<four_bar_packs::Model>();
}

/// The crane's sines are of time, in two parts.
TEST(TurnedSines, AreOfTimeToo) {
  using Number = Turning<double, 2>;
  const crane_packs::Model<Number> model;
  const auto start = initial_state(model);
  auto stage = start;
  stage.t = start.t + Number(0.05);
  Number at_start[3], turned[3], computed[3];
  {
    TurnedSines::Stages<Number> stages(2, 2);
    forward_dynamics(model, start, {}, at_start);
    forward_dynamics(model, stage, {}, turned);
  }
  forward_dynamics(model, stage, {}, computed);
  EXPECT_GT(std::fabs(computed[1][0] - at_start[1][0]), 1e-6);
  EXPECT_NEAR(turned[1][0], computed[1][0], 1e-15);
}

TEST(TurnedSines, AreOfAllStepsOfSeveralStages) {
  using Many = Turned<cart_pole_ensemble::Model, double>;
  using Plain = Ensemble<cart_pole_ensemble::Model, double, 4>;
  expect_rounding<Many, Plain>(heun, 1e-12);
  expect_rounding<Many, Plain>(rk5, 1e-12);
}

/// Steps without angles, or of one stage, have the bits of others.
template <class Many, class Plain, class Stepper>
void expect_bits(const Stepper& stepper) {
  Many turned = started<Many>();
  Plain plain = started<Plain>();
  turned.run(stepper, kStep, 60);
  plain.run(stepper, kStep, 60);
  for (std::size_t k = 0; k < kCount; ++k) EXPECT_EQ(difference(turned.state(k), plain.state(k)), 0) << k;
}

TEST(TurnedSines, OfFewStagesOrAnglesAreThoseOfOthers) {
  using Many = Turned<cart_pole_ensemble::Model, double>;
  using Plain = Ensemble<cart_pole_ensemble::Model, double, 4>;
  expect_bits<Many, Plain>(euler);
  expect_bits<Many, Plain>(semi_implicit_euler);
  expect_bits<Turned<quadrotor_packs::Model, double>, Ensemble<quadrotor_packs::Model, double, 4>>(rk4);
  expect_bits<Turned<cart_stops_packs::Model, double>, Ensemble<cart_stops_packs::Model, double, 4>>(rk4);
}

/// One of the states spins so fast that its sines are computed.
TEST(TurnedSines, DependOnNeitherThreadsNorNeighbours) {
  using Many = Turned<panda_packs::Model, double>;
  const Many::Model model;
  const auto of = [&model](std::size_t k) {
    Many::State state = start<Many>(model, k);
    if (k % 3 == 1) state.z[6] = 300;
    return state;
  };
  Many one(kCount), reversed(kCount), shared(kCount);
  for (std::size_t k = 0; k < kCount; ++k) {
    one.set_state(k, of(k));
    shared.set_state(k, of(k));
    reversed.set_state(k, of(kCount - 1 - k));
  }
  one.run(rk4, kStep, 30);
  reversed.run(rk4, kStep, 30);
  shared.run(rk4, kStep, 10, 3);
  shared.run(rk4, kStep, 20, 2);
  for (std::size_t k = 0; k < kCount; ++k) {
    EXPECT_EQ(difference(reversed.state(k), one.state(kCount - 1 - k)), 0) << k;
    EXPECT_EQ(difference(shared.state(k), one.state(k)), 0) << k;
  }
}

}  // namespace
}  // namespace jourdain::tests
