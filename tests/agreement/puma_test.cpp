// models/puma560.toml against the published outputs of the Puma 560.
#include <gtest/gtest.h>

#include "agreement/judge.hpp"
#include "agreement/shared_data.hpp"

namespace jourdain::tests {
namespace {

// The outputs were computed in double from the same numbers.
constexpr double kTolerance = 1e-13;

TEST(Puma560, AgreesWithThePublishedOutputs) {
  const PumaCase puma = read_puma_case();
  const reference::Reference<double> reference(read_model(model_path("puma560.toml")));
  const auto no_input = reference::VectorX<double>::Zero(Eigen::Index(reference.input_count()));
  const reference::Terms<double> terms = reference.evaluate({.t = 0, .y = puma.q, .z = puma.qd}, no_input);
  EXPECT_LE(normwise_error(terms.M, puma.M), kTolerance);
  EXPECT_LE(normwise_error(-terms.k_bar, puma.c), kTolerance);
  EXPECT_LE(normwise_error(terms.q_bar, puma.g), kTolerance);
  EXPECT_LE(normwise_error(terms.M * puma.qdd - terms.k_bar + terms.q_bar, puma.tau), kTolerance);
}

TEST(Puma560, ProgramAgreesWithThePublishedOutputs) {
  const PumaCase puma = read_puma_case();
  const Derived derived = derive(read_model(model_path("puma560.toml")));
  const auto list = [](const reference::VectorX<double>& v) {
    return std::vector<double>(v.begin(), v.end());
  };
  Sample sample{0,
                {},
                list(puma.q),
                list(puma.qd),
                std::vector<double>(derived.mechanism.actuators.size(), 0.0),
                list(puma.qdd)};
  const auto vector = [&](const char* function) {
    const std::vector<double> values = interpreted<double>(derived.module, function, sample);
    return reference::VectorX<double>(
        Eigen::Map<const reference::VectorX<double>>(values.data(), Eigen::Index(values.size())));
  };
  EXPECT_LE(normwise_error(-vector("k_bar"), puma.c), kTolerance);
  EXPECT_LE(normwise_error(vector("q_bar"), puma.g), kTolerance);
  EXPECT_LE(normwise_error(vector("inverse_dynamics"), puma.tau), kTolerance);
  const reference::VectorX<double> upper = vector("mass_matrix");
  reference::MatrixX<double> M(6, 6);
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = i; j < 6; ++j) M(i, j) = M(j, i) = upper[k++];
  EXPECT_LE(normwise_error(M, puma.M), kTolerance);
}

}  // namespace
}  // namespace jourdain::tests
