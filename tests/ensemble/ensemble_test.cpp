// States stepped side by side, of models of all kinds, against scalars stepped one after the other.
#include "jourdain/ensemble.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "cart_pole_ensemble/cart_pole_ensemble_kernels.hpp"
#include "cart_stops_packs/cart_stops_packs_kernels.hpp"
#include "crane_packs/crane_packs_kernels.hpp"
#include "four_bar_packs/four_bar_packs_kernels.hpp"
#include "panda_packs/panda_packs_kernels.hpp"
#include "quadrotor_packs/quadrotor_packs_kernels.hpp"
#include "quadruped_packs/quadruped_packs_kernels.hpp"
#include "states.hpp"
#include "wind_turbine_packs/wind_turbine_packs_kernels.hpp"

namespace jourdain::tests {
namespace {

template <template <class> class Model>
void expect_scalars_of(double tolerance) {
  expect_scalars<Ensemble<Model, double, 2>>(tolerance);
  expect_scalars<Ensemble<Model, double, 8>>(tolerance);
  expect_scalars<Ensemble<Model, float, 4>>(kRoundedSines);
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

TEST(Ensembles, CloseLoops) { expect_scalars<Ensemble<four_bar_packs::Model, double, 4>>(kNone); }

TEST(Ensembles, DependOnNeitherThreadsNorNeighbours) {
  using Many = Ensemble<panda_packs::Model, double, 4>;
  Many one = started<Many>();
  one.run(rk4, kStep, 30);
  for (const std::size_t threads :
       {std::size_t(0), std::size_t(2), std::size_t(3), std::size_t(16), ~std::size_t(0)}) {
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

TEST(Ensembles, SayWhichStatesAreNoNumbers) {
  expect_no_numbers_untrusted<Ensemble<panda_packs::Model, double, 4>>();
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
