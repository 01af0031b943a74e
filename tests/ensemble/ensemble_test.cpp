// States stepped side by side, of models of all kinds, against scalars stepped one after the other.
#include "jourdain/ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "cart_pole_ensemble/cart_pole_ensemble_kernels.hpp"
#include "cart_stops_packs/cart_stops_packs_kernels.hpp"
#include "crane_packs/crane_packs_kernels.hpp"
#include "four_bar_packs/four_bar_packs_kernels.hpp"
#include "jourdain/draws.hpp"
#include "panda_packs/panda_packs_kernels.hpp"
#include "quadrotor_packs/quadrotor_packs_kernels.hpp"
#include "quadruped_packs/quadruped_packs_kernels.hpp"
#include "wind_turbine_packs/wind_turbine_packs_kernels.hpp"

namespace jourdain::tests {
namespace {

constexpr std::size_t kCount = 11;  // no multiple of any number of lanes
constexpr double kStep = 1e-3;

/// How far numbers of states may be apart, as a share of 1 + their size.
constexpr double kNone = 0, kRoundedSines = 1e-5;

template <class State>
double difference(const State& a, const State& b) {
  double worst = 0;
  const auto compare = [&worst](double x, double y) {
    const double apart = std::fabs(x - y) / (1 + std::fabs(y));
    if (!(apart <= worst)) worst = apart;
  };
  for (std::size_t i = 0; i < std::size(a.y); ++i) compare(double(a.y[i]), double(b.y[i]));
  for (std::size_t i = 0; i < std::size(a.z); ++i) compare(double(a.z[i]), double(b.z[i]));
  return worst;
}

/// State k and its inputs, each its own.
template <class Ensemble>
typename Ensemble::State start(const typename Ensemble::Model& model, std::size_t k) {
  auto state = initial_state(model);
  std::uint64_t number = 0;
  for (auto& z : state.z) z += static_cast<std::decay_t<decltype(z)>>(0.3 * normal(1, k, number++));
  return state;
}
template <class Ensemble>
typename Ensemble::Input input(std::size_t k) {
  typename Ensemble::Input input{};
  if constexpr (Ensemble::Model::input_count > 0) {
    std::uint64_t number = 0;
    for (auto& u : input.u) u = static_cast<std::decay_t<decltype(u)>>(normal(2, k, number++));
  }
  return input;
}

template <class Ensemble>
Ensemble started() {
  Ensemble ensemble(kCount);
  const typename Ensemble::Model model;
  for (std::size_t k = 0; k < kCount; ++k) {
    ensemble.set_state(k, start<Ensemble>(model, k));
    ensemble.set_input(k, input<Ensemble>(k));
  }
  return ensemble;
}

template <template <class> class Model, class Real, std::size_t lanes>
void expect_scalars(double tolerance) {
  using Many = Ensemble<Model, Real, lanes>;
  Many ensemble = started<Many>();
  ensemble.run(rk4, static_cast<Real>(kStep), 60, 2);
  const Model<Real> model;
  for (std::size_t k = 0; k < kCount; ++k) {
    auto state = start<Many>(model, k);
    const auto begin = state;
    for (int i = 0; i < 60; ++i) rk4_step(model, state, input<Many>(k), static_cast<Real>(kStep));
    EXPECT_GT(difference(begin, state), 1e-6) << k;
    EXPECT_LE(difference(ensemble.state(k), state), tolerance) << k << " of " << lanes << " lanes";
    EXPECT_TRUE(ensemble.trusted(k)) << k;
  }
  EXPECT_EQ(ensemble.untrusted_count(), 0u);
}

template <template <class> class Model>
void expect_scalars_of(double tolerance) {
  expect_scalars<Model, double, 2>(tolerance);
  expect_scalars<Model, double, 8>(tolerance);
  expect_scalars<Model, float, 4>(kRoundedSines);
}

TEST(Ensembles, HaveTheBitsOfScalars) {
  expect_scalars_of<panda_packs::Model>(kNone);
  expect_scalars_of<crane_packs::Model>(kNone);
  expect_scalars_of<cart_pole_ensemble::Model>(kNone);
  expect_scalars_of<quadrotor_packs::Model>(kNone);
  expect_scalars_of<quadruped_packs::Model>(kNone);
}

/// After 12 days, where a product of rate and time in one number is off by 1e-10 rad.
template <class Real>
void expect_exact_angles(double t, double tolerance) {
  using Many = Ensemble<crane_packs::Model, Real, 4>;
  Many ensemble(kCount);
  const typename Many::Model model;
  std::vector<typename Many::State> states;
  for (std::size_t k = 0; k < kCount; ++k) {
    states.push_back(start<Many>(model, k));
    states[k].t = static_cast<Real>(t + 0.37 * static_cast<double>(k));
    ensemble.set_state(k, states[k]);
  }
  const auto h = static_cast<Real>(0.01);
  ensemble.run(rk4, h, 200);
  for (std::size_t k = 0; k < kCount; ++k) {
    for (int i = 0; i < 200; ++i) rk4_step(model, states[k], {}, h);
    EXPECT_LE(difference(ensemble.state(k), states[k]), tolerance) << k;
  }
}

TEST(Ensembles, KeepAnglesOfLongTimes) {
  expect_exact_angles<double>(1e6, kNone);
  expect_exact_angles<float>(1e3, kRoundedSines);
}

TEST(Ensembles, ChooseInEachLane) { expect_scalars_of<cart_stops_packs::Model>(kNone); }

TEST(Ensembles, TakeEntriesOfTables) { expect_scalars_of<wind_turbine_packs::Model>(kNone); }

TEST(Ensembles, CloseLoops) { expect_scalars<four_bar_packs::Model, double, 4>(kNone); }

TEST(Ensembles, DependOnNeitherThreadsNorNeighbours) {
  using Many = Ensemble<panda_packs::Model, double, 4>;
  Many one = started<Many>();
  one.run(rk4, kStep, 30);
  for (const std::size_t threads : {0, 2, 3, 16}) {
    Many same = started<Many>();
    same.run(rk4, kStep, 10, threads);
    same.run(rk4, kStep, 20, threads);
    for (std::size_t k = 0; k < kCount; ++k) EXPECT_EQ(difference(same.state(k), one.state(k)), 0) << threads;
  }
  Many reversed(kCount);
  for (std::size_t k = 0; k < kCount; ++k) {
    reversed.set_state(k, start<Many>(Many::Model(), kCount - 1 - k));
    reversed.set_input(k, input<Many>(kCount - 1 - k));
  }
  reversed.run(rk4, kStep, 30);
  for (std::size_t k = 0; k < kCount; ++k)
    EXPECT_EQ(difference(reversed.state(k), one.state(kCount - 1 - k)), 0) << k;
}

TEST(Ensembles, GiveEachStateItsParameters) {
  using Many = Ensemble<cart_pole_ensemble::Model, double, 4>;
  const auto own = [](std::size_t k) {
    Many::Parameters parameters;
    parameters.pole_half_length *= 1 + 0.1 * static_cast<double>(k);
    return parameters;
  };
  for (const std::size_t only : {std::size_t(3), kCount - 1, kCount}) {  // one alone, the last alone, all
    Many ensemble = started<Many>();
    const auto changed = [only](std::size_t k) { return only == kCount || k == only; };
    for (std::size_t k = 0; k < kCount; ++k)
      if (changed(k)) ensemble.set_parameters(k, own(k));
    ensemble.run(rk4, kStep, 20);
    const Many::Model standard;
    for (std::size_t k = 0; k < kCount; ++k) {
      const Many::Parameters parameters = changed(k) ? own(k) : Many::Parameters();
      EXPECT_EQ(ensemble.parameters(k).pole_half_length, parameters.pole_half_length) << k;
      auto state = start<Many>(standard, k), unchanged = state;
      for (int i = 0; i < 20; ++i) {
        rk4_step(Many::Model(parameters), state, input<Many>(k), kStep);
        rk4_step(standard, unchanged, input<Many>(k), kStep);
      }
      EXPECT_EQ(difference(ensemble.state(k), state), 0) << k;
      EXPECT_EQ(difference(unchanged, state) > 1e-9, changed(k) && k > 0) << k;
    }
  }
}

TEST(Ensembles, TakeInputsFromTheirStates) {
  using Many = Ensemble<cart_pole_ensemble::Model, double, 2>;
  Many ensemble = started<Many>();
  ensemble.run(rk4, kStep, 50, 2, [](const Many::Block& block, std::size_t step) {
    block.input.u[0] = Many::Number(-3.0) * block.state.z[0] + Many::Number(0.01 * static_cast<double>(step));
  });
  const Many::Model model;
  for (std::size_t k = 0; k < kCount; ++k) {
    auto state = start<Many>(model, k);
    auto held = input<Many>(k);
    for (int i = 0; i < 50; ++i) {
      held.u[0] = -3.0 * state.z[0] + 0.01 * i;
      rk4_step(model, state, held, kStep);
    }
    EXPECT_EQ(difference(ensemble.state(k), state), 0) << k;
    EXPECT_EQ(ensemble.input(k).u[0], held.u[0]) << k;
  }
}

TEST(Ensembles, TakeEveryStepper) {
  using Many = Ensemble<cart_pole_ensemble::Model, double, 2>;
  const Many::Model model;
  const auto expect = [&](const char* name, const auto& many, const auto& single) {
    Many ensemble = started<Many>();
    ensemble.run(many, kStep, 10, 2);
    ensemble.run(many, kStep, 10, 2);
    for (std::size_t k = 0; k < kCount; ++k) {
      auto state = start<Many>(model, k);
      single(state, input<Many>(k));
      EXPECT_EQ(difference(ensemble.state(k), state), 0) << name << " " << k;
    }
  };
  const auto twenty = [&model](const auto& stepper) {
    return [&model, stepper](auto& state, const auto& held) {
      for (int i = 0; i < 20; ++i) stepper(model, state, held, kStep);
    };
  };
  expect("euler", euler, twenty(euler));
  expect("semi_implicit_euler", semi_implicit_euler, twenty(semi_implicit_euler));
  expect("heun", heun, twenty(heun));
  expect("rk5", rk5, twenty(rk5));
  // What methods remember belongs to who calls them, here one for each block.
  std::vector<cart_pole_ensemble::RateHistory<2, Many::Number>> histories(Many(kCount).block_count());
  expect(
      "adams_bashforth3",
      [&](const auto& m, auto& s, const auto& u, const auto& h, std::size_t block) {
        adams_bashforth3_step(m, s, u, h, histories[block]);
      },
      [&](auto& state, const auto& held) {
        cart_pole_ensemble::RateHistory<2, double> history;
        for (int i = 0; i < 20; ++i) adams_bashforth3_step(model, state, held, kStep, history);
      });
  std::vector<cart_pole_ensemble::Accelerations<Many::Number>> accelerations(Many(kCount).block_count());
  expect(
      "rodas4",
      [&](const auto& m, auto& s, const auto& u, const auto& h, std::size_t block) {
        rodas4_step(m, s, u, h, accelerations[block]);
      },
      [&](auto& state, const auto& held) {
        cart_pole_ensemble::Accelerations<double> own;
        for (int i = 0; i < 20; ++i) rodas4_step(model, state, held, kStep, own);
      });
}

/// States of which `k` starts otherwise: it alone must not be trusted, and nothing else moves.
template <class Many, class Spoil>
void expect_untrusted(std::size_t k, const Spoil& spoil) {
  Many ensemble = started<Many>(), intact = started<Many>();
  auto spoiled = ensemble.state(k);
  spoil(spoiled);
  ensemble.set_state(k, spoiled);
  ensemble.run(rk4, kStep, 5);
  intact.run(rk4, kStep, 5);
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(ensemble.trusted(i), i != k) << i;
    if (i != k) {
      EXPECT_EQ(difference(ensemble.state(i), intact.state(i)), 0) << i;
    }
  }
  EXPECT_EQ(ensemble.untrusted_count(), 1u);
  ensemble.set_state(k, intact.state(k));
  EXPECT_EQ(ensemble.untrusted_count(), 0u);
}

TEST(Ensembles, SayWhichStatesAreNoNumbers) {
  using Many = Ensemble<panda_packs::Model, double, 4>;
  for (const std::size_t k : {std::size_t(0), std::size_t(5), kCount - 1}) {
    expect_untrusted<Many>(k,
                           [](Many::State& state) { state.y[2] = std::numeric_limits<double>::quiet_NaN(); });
    expect_untrusted<Many>(k,
                           [](Many::State& state) { state.z[1] = std::numeric_limits<double>::infinity(); });
    expect_untrusted<Many>(k, [](Many::State& state) { state.z[1] = 1e200; });
  }
}

TEST(Ensembles, SayWhoseLoopsAreOpen) {
  using Many = Ensemble<four_bar_packs::Model, double, 4>;
  expect_untrusted<Many>(6, [](Many::State& state) { state.y[1] += 2.0; });
}

TEST(Ensembles, NeedAState) {
  using Many = Ensemble<panda_packs::Model>;
  EXPECT_THROW(Many(0), std::invalid_argument);
}

}  // namespace
}  // namespace jourdain::tests
