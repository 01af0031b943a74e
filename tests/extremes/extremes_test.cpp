// Accelerations stay right to the last digits where masses, lengths, speeds, angles and stiffnesses are
// extreme: a part of the sweep that tests/bench/extremes.cpp makes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "extremes/extreme_sweep.hpp"

namespace jourdain::tests {
namespace {

/// Values per family and states per value.
constexpr int kValues = 5;
constexpr std::uint64_t kSeeds = 2;

// An entry of M, k̄ or q̄ is a sum of some tens of products, and so is a row of the factors; each rounds by u
// at most. What a family's loss explains multiplies it. The largest seen is 5.
constexpr double kBackward = 100;
// Forward error by u cond(M) where first-order theory holds: the same sums, seen through M⁻¹; k̄ and q̄ may cancel. The
// largest seen is 4.
constexpr double kForward = 100, kFirstOrder = 0.1;

std::string shown(const Measurement& m, const Accuracy& a) {
  return fmt::format(
      "value 2^{}, seed {}: backward {:.2g} u, forward {:.2g} u, cond {:.2g}, scaled {:.2g}, loss {:.2g}",
      m.exponent, m.seed, a.backward, a.forward, a.conditioning.condition, a.conditioning.scaled, a.loss);
}

/// Nothing is promised where M is singular in this precision, or where the numbers leave its range.
bool has_solution(const Accuracy& a) { return a.regular && !(a.left_range && !std::isfinite(a.backward)); }

void expect_accurate(const Measurement& m, const Accuracy& a, double unit_roundoff) {
  if (!has_solution(a)) return;
  EXPECT_LE(a.backward, kBackward * a.loss) << shown(m, a);
  const double amplification = a.conditioning.condition * a.loss;
  if (amplification * unit_roundoff < kFirstOrder) {
    EXPECT_LE(a.forward, kForward * amplification) << shown(m, a);
  }
}

class ExtremeFamily : public testing::TestWithParam<std::size_t> {};

TEST_P(ExtremeFamily, HasAccurateAccelerations) {
  const Family& family = extreme_families()[GetParam()];
  SCOPED_TRACE(family.name + ": " + family.swept);
  Sweep sweep(family);
  int solved = 0;
  for (const int exponent : exponents(family, kValues))
    for (const Measurement& m : sweep.at(exponent, kSeeds)) {
      expect_accurate(m, m.in_double, 0x1p-53);
      expect_accurate(m, m.in_float, 0x1p-24);
      solved += has_solution(m.in_double) + has_solution(m.in_float);
    }
  EXPECT_GT(solved, 0);
}

INSTANTIATE_TEST_SUITE_P(All, ExtremeFamily, testing::Range<std::size_t>(0, extreme_families().size()));

/// At the value 2^exponent of the family `name`.
Accuracy in_double(const std::string& name, int exponent) {
  for (const Family& family : extreme_families())
    if (family.name == name) return Sweep(family).at(exponent, 1).front().in_double;
  throw std::runtime_error(name);
}

TEST(Extremes, AMassInAGimbalKeepsItsDigitsNearTheLock) {
  for (const char* name : {"mass in a gimbal, on the shaft", "mass in a gimbal, across"}) {
    const Accuracy a = in_double(name, -30);
    EXPECT_GT(a.conditioning.condition, 1e17) << name;
    EXPECT_LE(a.forward, kForward) << name;
  }
}

TEST(Extremes, ADistantArmKeepsItsDigits) {
  for (const char* name : {"distant arm", "distant arm, tunable"})
    for (const int exponent : {5, 6, 7, 8, 20}) {
      const Accuracy a = in_double(name, exponent);
      EXPECT_LE(a.backward, kBackward) << name << exponent;
    }
}

TEST(Extremes, TheConditionOfAStretchedPendulumIsTheClosedForm) {
  // With m1 = ε, m2 = l1 = l2 = 1 and the elbow at δ: det M = ε + sin² δ, tr M = 3 + ε + 2 cos δ. The
  // Frobenius norms of a symmetric 2 × 2 matrix and of its inverse have the product (tr² − 2 det)/det.
  const double delta = 0x1p-20, det = 0x1p-40 + std::pow(std::sin(delta), 2);
  const double trace = 3 + 0x1p-40 + 2 * std::cos(delta);
  const Accuracy a = in_double("double pendulum, m1/m2 = 1e-12", -20);
  EXPECT_NEAR(a.conditioning.condition / ((trace * trace - 2 * det) / det), 1, 1e-9);
}

TEST(Extremes, TheCompilersValidationAcceptsExtremeScenes) {
  for (const Family& family : extreme_families()) {
    if (!family.in_scene) continue;
    for (const int exponent : {family.first, family.last}) {
      Sweep sweep(family);
      sweep.at(exponent, 0);
      for (const std::string& reason : sweep.refusals())
        ADD_FAILURE() << family.name << " 2^" << exponent << ": " << reason;
    }
  }
}

}  // namespace
}  // namespace jourdain::tests
