// Ensembles whose model calls functions of its user, which have data.
#include "own_functions.hpp"

#include <gtest/gtest.h>

#include "jourdain/device_ensemble.hpp"
#include "jourdain/ensemble.hpp"
#include "states.hpp"

namespace jourdain::tests {
namespace {

using Parameters = glider_packs::Parameters<double>;

Parameters lighter(std::size_t k) {
  Parameters parameters;
  parameters.mass *= 1 - 0.02 * static_cast<double>(k);
  return parameters;
}

/// Data before and after states get parameters of their own.
template <class Many, class Functions>
void expect_own_functions() {
  for (const bool early : {true, false}) {
    Many ensemble = started<Many>();
    Functions functions;
    functions.slope = decltype(functions.slope)(3.5);
    if (early) ensemble.set_functions(functions);
    for (std::size_t k = 0; k < kCount; k += 2) ensemble.set_parameters(k, lighter(k));
    if (!early) ensemble.set_functions(functions);
    ensemble.run(rk4, kStep, 40);
    for (std::size_t k = 0; k < kCount; ++k) {
      glider_packs::Model<double> model(k % 2 == 0 ? lighter(k) : Parameters());
      auto state = start<Many>(model, k), standard = state;
      for (int i = 0; i < 40; ++i) rk4_step(model, standard, {}, kStep);
      model.functions.slope = 3.5;
      for (int i = 0; i < 40; ++i) rk4_step(model, state, {}, kStep);
      EXPECT_EQ(difference(ensemble.state(k), state), 0) << k << early;
      EXPECT_GT(difference(standard, state), 1e-6) << k;
    }
  }
}

TEST(Ensembles, CallFunctionsWithTheirData) {
  using Many = Ensemble<glider_packs::Model, double, 4>;
  expect_own_functions<Many, glider_packs::Functions<Many::Number>>();
}

TEST(DeviceEnsembles, CallFunctionsWithTheirData) {
  expect_own_functions<DeviceEnsemble<glider_packs::Model>, glider_packs::Functions<double>>();
}

}  // namespace
}  // namespace jourdain::tests
