// Two bodies, springs, drives: M, k̄ and q̄ against the formulas of textbooks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/equations_at.hpp"
#include "extremes/extreme_scenes.hpp"

namespace jourdain::tests {
namespace {

constexpr double kRounding = 1e-13;  // formulas in double, numbers up to 50
constexpr double g = 9.81;

/// Two links in the vertical x-z plane; the axes are ±y, the second joint is at (l1, 0, 0).
model::Mechanism two_links(const char* first_axis, const char* second_axis) {
  return read_scene(std::string(R"([model]
name = "two links"
[[body]]
name = "upper"
mass = 3
center_of_mass = [0.2, 0, 0]
inertia = [0, 0.05, 0.05]
[[body]]
name = "lower"
mass = 2
center_of_mass = [0.3, 0, 0]
inertia = [0, 0.07, 0.07]
[[joint]]
name = "shoulder"
type = "revolute"
parent = "world"
child = "upper"
axis = )") + first_axis +
                    R"(
[[joint]]
name = "elbow"
type = "revolute"
parent = "upper"
child = "lower"
position = [0.5, 0, 0]
axis = )" + second_axis);
}

constexpr double m1 = 3, m2 = 2, c1 = 0.2, c2 = 0.3, l = 0.5, I1 = 0.05, I2 = 0.07;

// Craig, Introduction to Robotics, the planar two-link arm, with distributed masses. Angles downwards positive
// about +y.
TEST(TwoLinks, AreThePlanarArmOfTheTextbooks) {
  const double a = 0.4, b = 0.9, da = 1.3, db = -2.1;
  const EquationsAt e = equations_at(two_links("[0, 1, 0]", "[0, 1, 0]"), {{a, b}, {da, db}});
  const double h = m2 * l * c2 * std::sin(b), cosine = m2 * l * c2 * std::cos(b);
  EXPECT_NEAR(e.M[0][0], I1 + m1 * c1 * c1 + I2 + m2 * (l * l + c2 * c2) + 2 * cosine, kRounding);
  EXPECT_NEAR(e.M[0][1], I2 + m2 * c2 * c2 + cosine, kRounding);
  EXPECT_NEAR(e.M[1][1], I2 + m2 * c2 * c2, kRounding);
  EXPECT_NEAR(e.k_bar[0], h * db * db + 2 * h * da * db, kRounding);
  EXPECT_NEAR(e.k_bar[1], -h * da * da, kRounding);
  const double lower = m2 * g * c2 * std::cos(a + b);
  EXPECT_NEAR(e.q_bar[0], -(m1 * c1 + m2 * l) * g * std::cos(a) - lower, kRounding);
  EXPECT_NEAR(e.q_bar[1], -lower, kRounding);
}

// An elbow about −y: its angle and rate count the other way.
TEST(TwoLinks, AReversedElbowChangesTheSignsOfItsAngle) {
  const double a = 0.4, b = 0.9, da = 1.3, db = -2.1;
  const EquationsAt e = equations_at(two_links("[0, 1, 0]", "[0, -1, 0]"), {{a, b}, {da, db}});
  const double h = m2 * l * c2 * std::sin(-b), cosine = m2 * l * c2 * std::cos(b);
  EXPECT_NEAR(e.M[0][1], -(I2 + m2 * c2 * c2 + cosine), kRounding);
  EXPECT_NEAR(e.k_bar[0], h * db * db - 2 * h * da * db, kRounding);
  EXPECT_NEAR(e.k_bar[1], h * da * da, kRounding);
  EXPECT_NEAR(e.q_bar[1], m2 * g * c2 * std::cos(a - b), kRounding);
}

// A shoulder about −y: the run of parallel axes begins with a reversed one.
TEST(TwoLinks, AReversedShoulderChangesTheSignsOfItsAngle) {
  const double a = 0.4, b = 0.9, da = 1.3, db = -2.1;
  const EquationsAt e = equations_at(two_links("[0, -1, 0]", "[0, 1, 0]"), {{a, b}, {da, db}});
  const double h = m2 * l * c2 * std::sin(b);
  EXPECT_NEAR(e.k_bar[0], -(h * db * db - 2 * h * da * db), kRounding);
  EXPECT_NEAR(e.k_bar[1], -h * da * da, kRounding);
  const double lower = m2 * g * c2 * std::cos(b - a);
  EXPECT_NEAR(e.q_bar[0], (m1 * c1 + m2 * l) * g * std::cos(a) + lower, kRounding);
  EXPECT_NEAR(e.q_bar[1], -lower, kRounding);
}

// A slide on a turning arm: m r̈ = m r φ̇² …, m r² φ̈ = −2 m r ṙ φ̇ …
TEST(TwoBodies, ASliderOnATurningArmFeelsCentrifugalAndCoriolisForces) {
  const double r = 0.6, dr = -1.4, rate = 2.2, m = 2;
  const EquationsAt e = equations_at(read_scene(R"([model]
name = "slider on an arm"
[[body]]
name = "arm"
mass = 0
inertia = [0, 0, 0.1]
inertia_kind = "lumped"
[[body]]
name = "slider"
mass = 2
[[joint]]
name = "turn"
type = "revolute"
parent = "world"
child = "arm"
[[joint]]
name = "slide"
type = "prismatic"
parent = "arm"
child = "slider"
axis = [1, 0, 0]
)"),
                                     {{0.3, r}, {rate, dr}});
  EXPECT_NEAR(e.M[0][0], 0.1 + m * r * r, kRounding);
  EXPECT_NEAR(e.k_bar[0], -2 * m * r * dr * rate, kRounding);
  EXPECT_NEAR(e.k_bar[1], m * r * rate * rate, kRounding);
}

// A rotor with moment A about its axis y on a frame that turns about z: the moment −A Ω ω about x is what its
// bearing x feels.
TEST(TwoBodies, ASpinningRotorPushesItsGimbal) {
  const double A = 0.4, spin = 30, yaw = 0.5;
  const EquationsAt e = equations_at(read_scene(R"([model]
name = "gimbal"
[[body]]
name = "fork"
mass = 0
inertia = [0, 0, 0.1]
inertia_kind = "lumped"
[[body]]
name = "ring"
mass = 0
inertia = [0.2, 0, 0]
inertia_kind = "lumped"
[[body]]
name = "rotor"
mass = 2
inertia = [0.3, 0.4, 0.3]
[[joint]]
name = "yaw"
type = "revolute"
parent = "world"
child = "fork"
[[joint]]
name = "tilt"
type = "revolute"
parent = "fork"
child = "ring"
axis = [1, 0, 0]
[[joint]]
name = "spin"
type = "revolute"
parent = "ring"
child = "rotor"
axis = [0, 1, 0]
)"),
                                     {{0.2, 0, 0.7}, {yaw, 0, spin}});
  EXPECT_NEAR(e.k_bar[1], A * spin * yaw, kRounding);
  EXPECT_NEAR(e.k_bar[0], 0, kRounding);
  EXPECT_NEAR(e.M[2][2], A, kRounding);
}

// A pendulum on a cart that is moved by x(t): k̄ = −m l cos φ ẍ. In the plane x-z, φ about −y from straight down.
TEST(TwoBodies, APrescribedCartShakesItsPendulum) {
  const double length = 0.8, m = 2, y = 0.6, t = 0.37, rate = 20;
  const EquationsAt e = equations_at(read_scene(R"toml([model]
name = "shaken pendulum"
[[body]]
name = "cart"
mass = 5
[[body]]
name = "bob"
mass = 2
center_of_mass = [0, 0, -0.8]
[[joint]]
name = "shake"
type = "prismatic"
parent = "world"
child = "cart"
axis = [1, 0, 0]
motion = "0.1*sin(20*t)"
[[joint]]
name = "hinge"
type = "revolute"
parent = "cart"
child = "bob"
axis = [0, -1, 0]
)toml"),
                                     {{y}, {1.3}, {}, t});
  const double acceleration = -0.1 * rate * rate * std::sin(rate * t);
  EXPECT_NEAR(e.k_bar[0], -m * length * std::cos(y) * acceleration, kRounding * 10);
  EXPECT_NEAR(e.q_bar[0], m * g * length * std::sin(y), kRounding);
}

// A spring across a slide at the height h: tension k (L − L0) + c L̇ with L = √(x² + h²), its share along x is x/L.
TEST(Springs, PullAlongTheLineBetweenTheirEnds) {
  const double x = 0.4, h = 0.3, dx = -1.2, L = 0.5, k = 100, damping = 7, L0 = 0.35;
  const model::Mechanism scene = one_body("mass = 2", "type = \"prismatic\"\naxis = [1, 0, 0]", R"(
[[frame]]
name = "anchor"
body = "world"
position = [0, 0, 0.3]
[[spring]]
from = "anchor"
to = "b"
stiffness = 100
damping = 7
free_length = 0.35
)");
  const EquationsAt e = equations_at(scene, {{x}, {dx}});
  EXPECT_NEAR(std::hypot(x, h), L, kRounding);
  const double tension = k * (L - L0) + damping * dx * x / L;
  EXPECT_NEAR(e.q_bar[0], tension * x / L, 1e-12);  // lengths are smoothed over 1e-12 m
  EXPECT_NEAR(e.potential_energy, k * (L - L0) * (L - L0) / 2, 1e-12);
}

TEST(Springs, OfACoordinateAndItsDamperPushBack) {
  const EquationsAt e = equations_at(
      one_body("mass = 2", "type = \"prismatic\"\naxis = [1, 0, 0]\nstiffness = 50\nrest = 0.1\ndamping = 3"),
      {{0.4}, {-1.2}});
  EXPECT_NEAR(e.q_bar[0], 50 * (0.4 - 0.1) + 3 * -1.2, kRounding);
  EXPECT_NEAR(e.potential_energy, 50 * 0.3 * 0.3 / 2, kRounding);
}

// Motor torque u through a gear n: force n u, rotor inertia n² J.
TEST(Actuators, SeeTheGearOnceInTheForceAndTwiceInTheInertia) {
  const EquationsAt e =
      equations_at(one_body("mass = 2\ninertia = [0, 0, 0.5]\ninertia_kind = \"lumped\"",
                            "type = \"revolute\"\naxis = [0, 0, 1]",
                            "[[actuator]]\njoint = \"j\"\ngear_ratio = 10\nrotor_inertia = 0.003"),
                   {{0.4}, {2}, {1.5}});
  EXPECT_NEAR(e.M[0][0], 0.5 + 100 * 0.003, kRounding);
  EXPECT_NEAR(e.q_bar[0], -10 * 1.5, kRounding);
  EXPECT_NEAR(e.kinetic_energy, 0.8 * 4 / 2, kRounding);
}

}  // namespace
}  // namespace jourdain::tests
