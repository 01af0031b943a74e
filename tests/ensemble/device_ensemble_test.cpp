// Ensembles of devices where the host stands for one: each state against itself, stepped alone.
#include "jourdain/device_ensemble.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "cart_pole_ensemble/cart_pole_ensemble_kernels.hpp"
#include "crane_packs/crane_packs_kernels.hpp"
#include "four_bar_packs/four_bar_packs_kernels.hpp"
#include "panda_packs/panda_packs_kernels.hpp"
#include "quadruped_packs/quadruped_packs_kernels.hpp"
#include "states.hpp"
#include "wind_turbine_packs/wind_turbine_packs_kernels.hpp"

namespace jourdain::tests {
namespace {

template <template <class> class Model>
void expect_scalars_of() {
  expect_scalars<DeviceEnsemble<Model, double>>(kNone);
  expect_scalars<DeviceEnsemble<Model, float>>(kNone);
}

TEST(DeviceEnsembles, HaveTheBitsOfStatesSteppedAlone) {
  expect_scalars_of<panda_packs::Model>();
  expect_scalars_of<crane_packs::Model>();
  expect_scalars_of<cart_pole_ensemble::Model>();
  expect_scalars_of<quadruped_packs::Model>();
  expect_scalars_of<wind_turbine_packs::Model>();
  expect_scalars<DeviceEnsemble<four_bar_packs::Model, double>>(kNone);
}

using CartPoles = DeviceEnsemble<cart_pole_ensemble::Model>;

TEST(DeviceEnsembles, GiveEachStateItsParameters) {
  const auto own = [](std::size_t k) {
    CartPoles::Parameters parameters;
    parameters.pole_half_length *= 1 + 0.1 * static_cast<double>(k);
    return parameters;
  };
  CartPoles ensemble = started<CartPoles>();
  for (std::size_t k = 1; k < kCount; k += 2) ensemble.set_parameters(k, own(k));
  ensemble.run(rk4, kStep, 20);
  ensemble.set_parameters(0, own(3));
  ensemble.run(rk4, kStep, 20);
  for (std::size_t k = 0; k < kCount; ++k) {
    const CartPoles::Parameters parameters = k % 2 == 1 ? own(k) : CartPoles::Parameters();
    auto state = start<CartPoles>(CartPoles::Model(), k);
    for (int i = 0; i < 40; ++i)
      rk4_step(CartPoles::Model(k == 0 && i >= 20 ? own(3) : parameters), state, input<CartPoles>(k), kStep);
    EXPECT_EQ(difference(ensemble.state(k), state), 0) << k;
    EXPECT_EQ(ensemble.parameters(k).pole_half_length, (k == 0 ? own(3) : parameters).pole_half_length) << k;
  }
}

struct Law {
  const double* gains;
  void operator()(std::size_t k, std::size_t step, const CartPoles::State& state,
                  CartPoles::Input& input) const {
    input.u[0] = -gains[k] * state.z[0] + 0.01 * static_cast<double>(step);
  }
};

TEST(DeviceEnsembles, TakeInputsFromTheirStates) {
  OnDevice<double> gains(kCount);
  for (std::size_t k = 0; k < kCount; ++k) gains.write()[k] = 3 + static_cast<double>(k);
  CartPoles ensemble = started<CartPoles>();
  ensemble.run(rk4, kStep, 50, Law{gains.read_on_device()});
  for (std::size_t k = 0; k < kCount; ++k) {
    auto state = start<CartPoles>(CartPoles::Model(), k);
    auto held = input<CartPoles>(k);
    for (std::size_t i = 0; i < 50; ++i) {
      Law{gains.read().data()}(k, i, state, held);
      rk4_step(CartPoles::Model(), state, held, kStep);
    }
    EXPECT_EQ(difference(ensemble.state(k), state), 0) << k;
    EXPECT_EQ(ensemble.input(k).u[0], held.u[0]) << k;
  }
}

struct AdamsBashforth {
  cart_pole_ensemble::RateHistory<2, double>* histories;
  void operator()(const CartPoles::Model& m, CartPoles::State& s, const CartPoles::Input& u, double h,
                  std::size_t k) const {
    adams_bashforth3_step(m, s, u, h, histories[k]);
  }
};

TEST(DeviceEnsembles, TakeSteppersThatRemember) {
  OnDevice<cart_pole_ensemble::RateHistory<2, double>> histories(kCount);
  CartPoles ensemble = started<CartPoles>();
  for (int part = 0; part < 2; ++part) ensemble.run(AdamsBashforth{histories.write_on_device()}, kStep, 10);
  for (std::size_t k = 0; k < kCount; ++k) {
    auto state = start<CartPoles>(CartPoles::Model(), k);
    cart_pole_ensemble::RateHistory<2, double> history;
    for (int i = 0; i < 20; ++i)
      adams_bashforth3_step(CartPoles::Model(), state, input<CartPoles>(k), kStep, history);
    EXPECT_EQ(difference(ensemble.state(k), state), 0) << k;
  }
}

TEST(DeviceEnsembles, SayWhichStatesAreNoNumbers) {
  expect_no_numbers_untrusted<DeviceEnsemble<panda_packs::Model>>();
}

TEST(DeviceEnsembles, SayWhoseLoopsAreOpen) {
  expect_untrusted<DeviceEnsemble<four_bar_packs::Model>>(6, [](auto& state) { state.y[1] += 2.0; });
}

TEST(DeviceEnsembles, CanBeMoved) {
  CartPoles first = started<CartPoles>();
  CartPoles second = std::move(first);
  second.run(rk4, kStep, 1);
  EXPECT_EQ(second.untrusted_count(), 0u);
}

TEST(DeviceEnsembles, NeedAState) { EXPECT_THROW(CartPoles(0), std::invalid_argument); }

}  // namespace
}  // namespace jourdain::tests
