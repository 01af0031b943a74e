// One body on one joint: M, k̄ and q̄ against the formulas of textbooks, which use nothing of ours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/equations_at.hpp"
#include "properties/gimbals.hpp"

namespace jourdain::tests {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kRounding = 1e-13;  // formulas in double, numbers up to 50
constexpr double g = 9.81, m = 2;

auto near(double value) { return DoubleNear(value, kRounding); }

// Centre of mass at (a, b, c), inertia about it with products.
constexpr double a = 0.3, b = -0.4, c = 0.5, Ixx = 0.11, Iyy = 0.12, Izz = 0.13, Ixy = 0.01, Ixz = 0.02,
                 Iyz = 0.03;
const char* const kBody = R"(mass = 2
center_of_mass = [0.3, -0.4, 0.5]
inertia = { xx = 0.11, yy = 0.12, zz = 0.13, xy = 0.01, xz = 0.02, yz = 0.03 })";

// Izz of the tensor about the origin (Steiner), −∂U/∂y of U = m g (height of the centre).
TEST(OneJoint, ARevoluteBodyIsAPhysicalPendulum) {
  const double y = 0.7, z = 1.9, I = Ixx + m * (b * b + c * c);
  const EquationsAt e = equations_at(one_body(kBody, "type = \"revolute\"\naxis = [1, 0, 0]"), {{y}, {z}});
  const double height = b * std::sin(y) + c * std::cos(y), slope = b * std::cos(y) - c * std::sin(y);
  EXPECT_NEAR(e.M[0][0], I, kRounding);
  EXPECT_NEAR(e.k_bar[0], 0, kRounding);
  EXPECT_NEAR(e.q_bar[0], m * g * slope, kRounding);
  EXPECT_NEAR(e.kinetic_energy, I * z * z / 2, kRounding);
  EXPECT_NEAR(e.potential_energy, m * g * height, kRounding);
}

// About −x the body turns the other way.
TEST(OneJoint, AReversedAxisTurnsTheOtherWay) {
  const double y = 0.7;
  const EquationsAt e = equations_at(one_body(kBody, "type = \"revolute\"\naxis = [-1, 0, 0]"), {{y}, {1}});
  EXPECT_NEAR(e.q_bar[0], m * g * (-b * std::cos(y) - c * std::sin(y)), kRounding);
  EXPECT_NEAR(e.potential_energy, m * g * (-b * std::sin(y) + c * std::cos(y)), kRounding);
}

TEST(OneJoint, ASlideFeelsTheWeightAlongItsAxis) {
  const EquationsAt e =
      equations_at(one_body(kBody, "type = \"prismatic\"\naxis = [1, 2, -2]"), {{0.6}, {3}});
  EXPECT_NEAR(e.M[0][0], m, kRounding);
  EXPECT_NEAR(e.k_bar[0], 0, kRounding);
  EXPECT_NEAR(e.q_bar[0], m * g * (-2.0 / 3), kRounding);
  EXPECT_NEAR(e.potential_energy, m * g * (c - 0.6 * 2 / 3), kRounding);
}

TEST(OneJoint, AScrewMovesMassAndInertia) {
  const double pitch = 0.25;
  const EquationsAt e =
      equations_at(one_body(kBody, "type = \"screw\"\naxis = [0, 0, 1]\npitch = 0.25"), {{0.6}, {3}});
  EXPECT_NEAR(e.M[0][0], Izz + m * (a * a + b * b) + m * pitch * pitch, kRounding);
  EXPECT_NEAR(e.k_bar[0], 0, kRounding);
  EXPECT_NEAR(e.q_bar[0], m * g * pitch, kRounding);
}

TEST(OneJoint, AReversedScrewSinksAsItTurns) {
  const EquationsAt e =
      equations_at(one_body(kBody, "type = \"screw\"\naxis = [0, 0, -1]\npitch = 0.25"), {{0.6}, {3}});
  EXPECT_NEAR(e.q_bar[0], -m * g * 0.25, kRounding);
  EXPECT_NEAR(e.potential_energy, m * g * (c - 0.25 * 0.6), kRounding);
}

// ω = (cos β α̇, β̇, sin β α̇) in the body: T = ½ (A cos² β + C sin² β) α̇² + ½ B β̇², Lagrange's equations of it.
TEST(OneJoint, AUniversalJointHasTheGyroscopicTermsOfItsTwoAngles) {
  const double A = 0.11, B = 0.12, C = 0.18, alpha = 0.4, beta = 0.9, da = 1.3, db = -2.1;
  const EquationsAt e =
      equations_at(one_body("mass = 2\ninertia = [0.11, 0.12, 0.18]",
                            "type = \"universal\"\naxis = [1, 0, 0]\nsecond_axis = [0, 1, 0]"),
                   {{alpha, beta}, {da, db}});
  const double s = std::sin(beta), co = std::cos(beta);
  EXPECT_NEAR(e.M[0][0], A * co * co + C * s * s, kRounding);
  EXPECT_NEAR(e.M[0][1], 0, kRounding);
  EXPECT_NEAR(e.M[1][1], B, kRounding);
  EXPECT_NEAR(e.k_bar[0], -2 * (C - A) * s * co * da * db, kRounding);
  EXPECT_NEAR(e.k_bar[1], (C - A) * s * co * da * da, kRounding);
}

// A point mass at the distance l under two turns is the spherical pendulum: m l² cos² β α̈ = 2 m l² sin β cos
// β α̇ β̇ …, m l² β̈ = −m l² sin β cos β α̇² …
TEST(OneJoint, APointMassOnAUniversalJointIsTheSphericalPendulum) {
  const double l = 0.8, alpha = 0.4, beta = 0.9, da = 1.3, db = -2.1;
  const EquationsAt e =
      equations_at(one_body("mass = 2\ncenter_of_mass = [0, 0, -0.8]",
                            "type = \"universal\"\naxis = [1, 0, 0]\nsecond_axis = [0, 1, 0]"),
                   {{alpha, beta}, {da, db}});
  const double s = std::sin(beta), co = std::cos(beta), I = m * l * l;
  EXPECT_NEAR(e.M[0][0], I * co * co, kRounding);
  EXPECT_NEAR(e.k_bar[0], 2 * I * s * co * da * db, kRounding);
  EXPECT_NEAR(e.k_bar[1], -I * s * co * da * da, kRounding);
  EXPECT_NEAR(e.q_bar[0], m * g * l * std::sin(alpha) * co, kRounding);
  EXPECT_NEAR(e.q_bar[1], m * g * l * std::cos(alpha) * s, kRounding);
}

TEST(OneJoint, APlanarBodyHasCentrifugalForcesOfItsOffset) {
  const double y = 0.7, rate = 1.7;
  const EquationsAt e =
      equations_at(one_body("mass = 2\ncenter_of_mass = [0.3, 0, 0]\ninertia = [0, 0.13, 0.13]",
                            "type = \"planar\"\naxis = [0, 0, 1]"),
                   {{0.1, 0.2, y}, {5, 6, rate}});
  const double s = std::sin(y), co = std::cos(y);
  EXPECT_THAT(e.M[0], ElementsAre(near(m), near(0), near(-m * a * s)));
  EXPECT_THAT(e.M[1], ElementsAre(near(0), near(m), near(m * a * co)));
  EXPECT_NEAR(e.M[2][2], 0.13 + m * a * a, kRounding);
  EXPECT_THAT(e.k_bar, ElementsAre(near(m * a * co * rate * rate), near(m * a * s * rate * rate), near(0)));
}

/// I_O ω for the body of kBody with the tensor about the joint (Steiner; tensor entries of products are ∓).
std::array<double, 3> angular_momentum(double x, double y, double z) {
  const double xx = Ixx + m * (b * b + c * c), yy = Iyy + m * (a * a + c * c), zz = Izz + m * (a * a + b * b),
               xy = Ixy - m * a * b, xz = Ixz - m * a * c, yz = Iyz - m * b * c;
  return {xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z};
}

// Euler's equations about the fixed point: I_O ω̇ + ω × I_O ω = c × Rᵀ m g; here R = 1.
TEST(OneJoint, ABallObeysEulersEquationsAboutItsCentre) {
  const EquationsAt e =
      equations_at(one_body(kBody, "type = \"spherical\""), {{1, 0, 0, 0}, {0.3, -0.7, 1.1}});
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = angular_momentum(k == 0, k == 1, k == 2);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(e.M[i][k], column[i], kRounding) << i << k;
  }
  const auto L = angular_momentum(0.3, -0.7, 1.1);
  EXPECT_THAT(e.k_bar, ElementsAre(near(-(-0.7 * L[2] - 1.1 * L[1])), near(-(1.1 * L[0] - 0.3 * L[2])),
                                   near(-(0.3 * L[1] + 0.7 * L[0]))));
  EXPECT_THAT(e.q_bar, ElementsAre(near(m * g * b), near(-m * g * a), near(0)));  // −c × (0, 0, −m g)
  EXPECT_THAT(e.ydot, ElementsAre(near(0), near(0.15), near(-0.35), near(0.55)));
}

// ẏ = ½ quat ⊗ (0, ω) at quat = (½, ½, ½, ½), Hamilton's product, w first.
TEST(OneJoint, AQuaternionsRateIsHalfItsProductWithTheBodysSpin) {
  const EquationsAt e =
      equations_at(one_body(kBody, "type = \"spherical\""), {{0.5, 0.5, 0.5, 0.5}, {2, 4, 8}});
  EXPECT_THAT(e.ydot, ElementsAre(near(-3.5), near(1.5), near(-0.5), near(2.5)));
}

// x → y → z → x: the centre (a, b, c) of the body stands at (c, a, b), so its height is b.
TEST(OneJoint, AQuaternionTurnsTheBodyNotTheWorld) {
  const EquationsAt e =
      equations_at(one_body(kBody, "type = \"spherical\""), {{0.5, 0.5, 0.5, 0.5}, {0, 0, 0}});
  EXPECT_NEAR(e.potential_energy, m * g * b, kRounding);
}

TEST(OneJoint, AGimbalIsThreeHingesWithNothingBetween) {
  const StateNumbers state{{0.4, 0.9, -2.3}, {1.3, -2.1, 0.8}};
  for (const Sequence& sequence : all_sequences()) {
    model::Mechanism gimbal =
        one_body(kBody, "type = \"gimbal\"\nfirst = { stiffness = 3 }\nthird = { damping = 2 }");
    gimbal.joints[0].sequence = sequence;
    const EquationsAt e = equations_at(gimbal, state), hinges = equations_at(on_hinges(gimbal), state);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_THAT(e.M[i], ElementsAre(near(hinges.M[i][0]), near(hinges.M[i][1]), near(hinges.M[i][2])));
      EXPECT_NEAR(e.k_bar[i], hinges.k_bar[i], kRounding);
      EXPECT_NEAR(e.q_bar[i], hinges.q_bar[i], kRounding);
    }
    EXPECT_NEAR(e.kinetic_energy, hinges.kinetic_energy, kRounding);
    EXPECT_NEAR(e.potential_energy, hinges.potential_energy, kRounding);
  }
}

TEST(OneJoint, APointIsAMassThatDoesNotTurn) {
  const EquationsAt e =
      equations_at(one_body(kBody, "type = \"point\"\nrpy = [0.5, 0, 0]\nx = { stiffness = 3 }"),
                   {{0.1, 0.2, 0.3}, {5, 6, 7}});
  EXPECT_THAT(e.M[0], ElementsAre(near(m), near(0), near(0)));
  EXPECT_THAT(e.M[1], ElementsAre(near(0), near(m), near(0)));
  EXPECT_THAT(e.M[2], ElementsAre(near(0), near(0), near(m)));
  EXPECT_THAT(e.k_bar, ElementsAre(near(0), near(0), near(0)));
  EXPECT_THAT(e.q_bar, ElementsAre(near(3 * 0.1), near(m * g * std::sin(0.5)), near(m * g * std::cos(0.5))));
  EXPECT_NEAR(e.kinetic_energy, m * (25 + 36 + 49) / 2.0, kRounding);
}

// m v̇ = m g, I ω̇ = −ω × I ω with diagonal I.
TEST(OneJoint, AFreeBodyObeysNewtonAndEuler) {
  const EquationsAt e = equations_at(one_body("mass = 2\ninertia = [1, 2, 2.5]", "type = \"free\""),
                                     {{1, 2, 3, 0.5, 0.5, -0.5, 0.5}, {7, 8, 9, 0.3, -0.7, 1.1}});
  EXPECT_THAT(e.k_bar, ElementsAre(near(0), near(0), near(0), near((2 - 2.5) * -0.7 * 1.1),
                                   near((2.5 - 1) * 1.1 * 0.3), near((1 - 2) * 0.3 * -0.7)));
  EXPECT_THAT(e.q_bar, ElementsAre(near(0), near(0), near(m * g), near(0), near(0), near(0)));
  EXPECT_NEAR(e.M[3][3], 1, kRounding);
  EXPECT_NEAR(e.M[5][5], 2.5, kRounding);
}

// The bead on z = x²/2: M = m (1 + s²), k̄ = −m s ṡ², q̄ = m g s.
TEST(OneJoint, ABeadOnAParabolaIsPushedByItsCurvature) {
  const double s = 0.6, rate = 1.7;
  const EquationsAt e = equations_at(
      one_body("mass = 2", "type = \"curve\"\ncurve = [\"s\", \"0\", \"s^2/2\"]"), {{s}, {rate}});
  EXPECT_NEAR(e.M[0][0], m * (1 + s * s), kRounding);
  EXPECT_NEAR(e.k_bar[0], -m * s * rate * rate, kRounding);
  EXPECT_NEAR(e.q_bar[0], m * g * s, kRounding);
}

}  // namespace
}  // namespace jourdain::tests
