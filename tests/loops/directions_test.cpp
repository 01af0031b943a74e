// Axes of frames in expressions: laws and constraints against the same by angles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "agreement/judge.hpp"
#include "loops/closed_programs.hpp"
#include "model/read/read.hpp"
#include "properties/consistent_state.hpp"
#include "reference/descriptor.hpp"
#include "validate/translation.hpp"

namespace jourdain::tests {
namespace {

using VectorL = reference::VectorX<long double>;

/// Arm, forearm and hand turn about y; the frame `plate` stands 0.3 rad further than the hand.
model::Mechanism arm(const std::string& more, const std::string& start = "-0.5") {
  const std::string text = fmt::format(R"([model]
name = "arm"
[[body]]
name = "upper"
mass = 2
center_of_mass = [0.2, 0, 0.01]
inertia = [0.01, 0.03, 0.03]
[[body]]
name = "lower"
mass = 1.5
center_of_mass = [0.15, 0, 0]
inertia = [0.01, 0.02, 0.02]
[[body]]
name = "hand"
mass = 0.5
center_of_mass = [0.05, 0, 0.02]
inertia = [0.002, 0.003, 0.003]
[[joint]]
name = "a"
type = "revolute"
axis = [0, 1, 0]
parent = "world"
child = "upper"
initial_position = 0.4
[[joint]]
name = "b"
type = "revolute"
axis = [0, 1, 0]
position = [0.4, 0, 0]
parent = "upper"
child = "lower"
initial_position = -0.2
[[joint]]
name = "c"
type = "revolute"
axis = [0, 1, 0]
position = [0.3, 0, 0]
parent = "lower"
child = "hand"
initial_position = {}
[[frame]]
name = "plate"
body = "hand"
rpy = [0, 0.3, 0]
{})",
                                       start, more);
  support::Diagnostics diagnostics("arm.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism.value();
}

std::string torque(const std::string& law) {
  return fmt::format("[[force]]\njoint = \"a\"\nvalue = \"{}\"\n", law);
}

TEST(Directions, OfAFrameAreSinesAndCosinesOfItsAngle) {
  for (const auto& [direction, angle] : {std::pair{"plate.R_xx", "cos(a + b + c + 0.3)"},
                                         {"plate.R_xz", "sin(a + b + c + 0.3)"},
                                         {"plate.R_zx", "-sin(a + b + c + 0.3)"},
                                         {"plate.R_zz", "cos(a + b + c + 0.3)"},
                                         {"plate.R_yy", "1"},
                                         {"plate.R_xy", "0"},
                                         {"upper.R_zx", "-sin(a)"}}) {
    const Derived by_direction = derive(arm(torque(fmt::format("3*{0} + b.rate*{0}", direction)))),
                  by_angle = derive(arm(torque(fmt::format("3*({0}) + b.rate*({0})", angle))));
    const validate::Verdict verdict =
        validate::validate_translation(by_direction.mechanism, by_direction.equations, by_direction.module);
    EXPECT_TRUE(verdict.accepted()) << direction << ": " << verdict.failures.front();
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Sample sample = random_sample(by_angle.mechanism, seed);
      const auto found = interpreted<double>(by_direction.module, "forward_dynamics", sample),
                 expected = interpreted<double>(by_angle.module, "forward_dynamics", sample);
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-11 * (1 + std::fabs(expected[i]))) << direction;
    }
  }
}

/// Joints about skew axes: all nine against the numeric reference.
TEST(Directions, OfATurningBodyAreThoseOfTheReference) {
  std::string law = "0";
  for (const char* i : {"x", "y", "z"})
    for (const char* j : {"x", "y", "z"})
      law += fmt::format(" + {}*lever.R_{}{}", i == j ? 2 : 3, i, j) + fmt::format("*spun.R_{}{}", j, i);
  const std::string more =
      "[[body]]\nname = \"spun\"\nmass = 1\ninertia = [0.1, 0.2, 0.25]\n"
      "[[joint]]\nname = \"ball\"\ntype = \"spherical\"\nparent = \"lower\"\nchild = \"spun\"\n"
      "[[frame]]\nname = \"lever\"\nbody = \"spun\"\nrpy = [0.4, -1.1, 0.7]\nposition = [0.1, 0.2, 0.3]\n";
  const Derived derived = derive(arm(more + torque(law)));
  const validate::Verdict verdict =
      validate::validate_translation(derived.mechanism, derived.equations, derived.module);
  EXPECT_TRUE(verdict.accepted()) << verdict.failures.front();
}

/// The plate is kept level: its angle is a constant, as by a coupler.
TEST(Directions, KeepAFrameLevel) {
  const model::Mechanism
      by_direction = arm("[[loop]]\nname = \"level\"\ntype = \"residual\"\nresidual = \"plate.R_zx\"\n"),
      by_angles = arm("[[loop]]\nname = \"level\"\ntype = \"residual\"\nresidual = \"a + b + c + 0.3\"\n");
  const ClosedPrograms level(by_direction), expected(by_angles);
  ASSERT_EQ(level.plan().independent, expected.plan().independent);
  const auto states = consistent_states(by_direction, 3, 5);
  ASSERT_TRUE(states);
  for (const LoopState& state : *states) {
    const VectorL zdot = level.accelerations(state, VectorL()),
                  wanted = expected.accelerations(state, VectorL());
    EXPECT_LE((zdot - wanted).norm(), 1e-12 * wanted.norm());
    const auto described =
        reference::DescriptorReference<long double>(by_direction).solve(state.t, state.y, state.z, VectorL());
    VectorL of_independent(zdot.size());
    for (Eigen::Index k = 0; k < zdot.size(); ++k)
      of_independent[k] = described.zdot[Eigen::Index(level.plan().independent[std::size_t(k)])];
    EXPECT_LE((zdot - of_independent).norm(), 1e-12 * wanted.norm());
  }
}

}  // namespace
}  // namespace jourdain::tests
