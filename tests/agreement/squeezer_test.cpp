// models/squeezer.toml against the mass matrix of its open tree as the benchmark prints it.
#include <gtest/gtest.h>

#include <cmath>

#include "agreement/shared_data.hpp"
#include "properties/random_tree.hpp"

namespace jourdain::tests {
namespace {

// A few products of sines and cosines in double.
constexpr double kTolerance = 1e-14;

struct Entry {
  const char *row, *column;
  double value;
};

/// The entries that are not zero, at the angles Theta, Phi and Omega; kg m².
std::vector<Entry> published_mass_matrix(double Theta, double Phi, double Omega) {
  constexpr double m1 = 0.04325, m2 = 0.00365, m3 = 0.02373, m4 = 0.00706, m5 = 0.07050, m6 = 0.00706,
                   m7 = 0.05498;
  constexpr double I1 = 2.194e-6, I2 = 4.410e-7, I3 = 5.255e-6, I4 = 5.667e-7, I5 = 1.169e-5, I6 = 5.667e-7,
                   I7 = 1.912e-5;
  constexpr double rr = 0.007, ra = 0.00092, da = 0.0115, sa = 0.01874, sb = 0.01043, zt = 0.04, ta = 0.02308,
                   tb = 0.00916, u = 0.04, ua = 0.01228, ub = 0.00449;
  constexpr double e_ea = 0.02 - 0.01421, zf_fa = 0.02 - 0.01421;
  return {
      {"beta", "beta", m1 * ra * ra + m2 * (rr * rr - 2 * da * rr * std::cos(Theta) + da * da) + I1 + I2},
      {"Theta", "beta", m2 * (da * da - da * rr * std::cos(Theta)) + I2},
      {"Theta", "Theta", m2 * da * da + I2},
      {"gamma", "gamma", m3 * (sa * sa + sb * sb) + I3},
      {"Phi", "Phi", m4 * e_ea * e_ea + I4},
      {"delta", "Phi", m4 * (e_ea * e_ea + zt * e_ea * std::sin(Phi)) + I4},
      {"delta", "delta",
       m4 * (zt * zt + 2 * zt * e_ea * std::sin(Phi) + e_ea * e_ea) + m5 * (ta * ta + tb * tb) + I4 + I5},
      {"Omega", "Omega", m6 * zf_fa * zf_fa + I6},
      {"epsilon", "Omega", m6 * (zf_fa * zf_fa - u * zf_fa * std::sin(Omega)) + I6},
      {"epsilon", "epsilon",
       m6 * (zf_fa * zf_fa - 2 * u * zf_fa * std::sin(Omega) + u * u) + m7 * (ua * ua + ub * ub) + I6 + I7}};
}

TEST(Squeezer, ItsTreeHasThePublishedMassMatrix) {
  const model::Mechanism mechanism = read_model(model_path("squeezer.toml"));
  const std::vector<std::string> names = model::lay_out_coordinates(mechanism).position_names;
  ASSERT_EQ(names.size(), 7u);
  const auto at = [&](const std::string& name) {
    return Eigen::Index(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const reference::Reference<double> reference(mechanism);
  const auto no_input = reference::VectorX<double>::Zero(0);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const reference::State<double> state = random_state(mechanism, seed);
    reference::MatrixX<double> M = reference::MatrixX<double>::Zero(7, 7);
    for (const auto& [row, column, value] :
         published_mass_matrix(state.y[at("Theta")], state.y[at("Phi")], state.y[at("Omega")]))
      M(at(row), at(column)) = M(at(column), at(row)) = value;
    EXPECT_LE(normwise_error(reference.evaluate(state, no_input).M, M), kTolerance);
  }
}

}  // namespace
}  // namespace jourdain::tests
