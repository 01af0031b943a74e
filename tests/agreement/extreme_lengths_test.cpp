// Accelerations in double where lengths and masses of a chain differ by many orders of magnitude, and how the
// way to compute them is chosen.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "agreement/shared_data.hpp"
#include "compile/articulation.hpp"

namespace jourdain::tests {
namespace {

using ir::LeafKind;

ir::Program accelerations(const model::Mechanism& mechanism, bool planar) {
  dynamics::DerivationOptions options;
  options.planar = planar;
  return lower_accelerations(mechanism, options);
}

/// Median over states of the error in units of rounding of the largest acceleration.
double median_units(const ir::Program& zdot, const std::vector<double>& parameters) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-3, 3);
  std::vector<double> units;
  for (int k = 0; k < 101; ++k) {
    ir::LeafValues<double> at;
    at[LeafKind::kParameter] = parameters;
    at[LeafKind::kPosition] = {number(random), number(random)};
    at[LeafKind::kVelocity] = {number(random), number(random)};
    ir::LeafValues<support::ScaledReal> exact_at;
    for (const LeafKind kind : {LeafKind::kParameter, LeafKind::kPosition, LeafKind::kVelocity})
      exact_at[kind].assign(at[kind].begin(), at[kind].end());
    const std::vector<double> found = ir::interpret(zdot, at);
    const std::vector<support::ScaledReal> exact = ir::interpret(zdot, exact_at);
    double error = 0, largest = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      largest = std::max(largest, std::fabs(static_cast<double>(exact[i])));
      error = std::isfinite(found[i])
                  ? std::max(error, std::fabs(static_cast<double>(exact[i] - support::ScaledReal(found[i]))))
                  : INFINITY;
    }
    units.push_back(error / largest / 0x1p-53);
  }
  std::nth_element(units.begin(), units.begin() + 50, units.end());
  return units[50];
}

TEST(ExtremeLengths, OfADoublePendulumKeepItsDigits) {
  const model::Mechanism mechanism = read_model(model_path("double_pendulum.toml"));
  const Articulation chosen = choose_articulation(mechanism, {});
  EXPECT_TRUE(chosen.planar);
  dynamics::DerivationOptions options;
  chosen.set(options);
  const ir::Program links = lower_accelerations(mechanism, options), joints = accelerations(mechanism, false);
  for (int e = -9; e <= 9; ++e) {
    const std::vector<double> parameters = {1, 1, 1, std::pow(10.0, e)};
    EXPECT_LE(median_units(links, parameters), 20) << "l2/l1 = 1e" << e;
    if (e >= 3) {
      EXPECT_GE(median_units(joints, parameters), 1e4) << "l2/l1 = 1e" << e;
    }
  }
  for (const double mass : {1e-9, 1e-3, 1e3, 1e9})
    EXPECT_LE(median_units(links, {1, mass, 1, 1}), 20) << "m2/m1 = " << mass;
}

TEST(ExtremeLengths, AreSampledWhereAWayIsChosen) {
  const model::Mechanism mechanism = read_model(model_path("double_pendulum.toml"));
  const ForwardError errors(mechanism);
  const SampledError joints = errors.of(accelerations(mechanism, false));
  EXPECT_GE(joints.units, 1e4);
  EXPECT_EQ(joints.where, "l1 = 1e-06");  // or l2 = 1e+06
  EXPECT_LE(errors.of(accelerations(mechanism, true)).units, 32);
}

}  // namespace
}  // namespace jourdain::tests
