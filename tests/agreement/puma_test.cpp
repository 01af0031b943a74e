// models/puma560.toml against the published outputs of the Puma 560.
#include <gtest/gtest.h>

#include "shared_data.hpp"

namespace jourdain::tests {
namespace {

// The outputs were computed in double from the same numbers.
constexpr double kTolerance = 1e-13;

TEST(Puma560, AgreesWithThePublishedOutputs) {
  if (!std::filesystem::exists(shared_path("reference/puma560.json")))
    GTEST_SKIP() << "no reference/puma560.json";
  const PumaCase puma = read_puma_case();
  const reference::Reference<double> reference(read_model(model_path("puma560.toml")));
  const auto no_input = reference::VectorX<double>::Zero(Eigen::Index(reference.input_count()));
  const reference::Terms<double> terms = reference.evaluate({.t = 0, .y = puma.q, .z = puma.qd}, no_input);
  EXPECT_LE(normwise_error(terms.M, puma.M), kTolerance);
  EXPECT_LE(normwise_error(-terms.k_bar, puma.c), kTolerance);
  EXPECT_LE(normwise_error(terms.q_bar, puma.g), kTolerance);
  EXPECT_LE(normwise_error(terms.M * puma.qdd - terms.k_bar + terms.q_bar, puma.tau), kTolerance);
}

}  // namespace
}  // namespace jourdain::tests
