// The generic driver over every model of the repository.
#include "embed/generic_driver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "embed/emitted_models.hpp"

namespace jourdain::tests {
namespace {

// Rounding of a few hundred operations, of the largest term of a row.
constexpr double kRounding = 1e-11;

/// A hundred steps from the initial state, so that few terms vanish.
template <class Model>
void check(const char* name) {
  const Model model;
  auto state = initial_state(model);
  const typename Model::Input input{};
  for (int i = 0; i < 100; ++i) rk4_step(model, state, input, 1e-4);
  if constexpr (requires { state.t; }) {
    EXPECT_NEAR(state.t, 0.01, 1e-15) << name;
  }
  Results<Model> r;
  visit_functions(model, state, input, r, [](const char*, auto&& call) { call(); });
  EXPECT_TRUE(std::isfinite(r.kinetic) && r.kinetic >= 0 && std::isfinite(r.potential)) << name;
  if constexpr (requires { project(model, state); })
    return;  // with multipliers G^T lambda is missing: tests/loops
  for (int i = 0; i < Model::velocity_count; ++i) {
    double residual = r.q[i] - r.k[i], scale = std::fabs(r.q[i]) + std::fabs(r.k[i]);
    for (int j = 0; j < Model::velocity_count; ++j) {
      residual += r.M[i][j] * r.zdot[j];
      scale += std::fabs(r.M[i][j] * r.zdot[j]);
    }
    EXPECT_LE(std::fabs(residual), kRounding * scale) << name << " row " << i;
    EXPECT_LE(std::fabs(r.tau[i]), kRounding * scale) << name << " row " << i;
  }
}

TEST(GenericDriver, FindsTheEquationsOfMotionInEveryModel) {
#define JOURDAIN_DRIVE(name) check<::name::Model<>>(#name);
  JOURDAIN_EMITTED_MODELS(JOURDAIN_DRIVE)
}

}  // namespace
}  // namespace jourdain::tests
