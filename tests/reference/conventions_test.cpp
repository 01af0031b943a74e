// What readers, compiler and references share, so that no comparison between them sees it: units, angles,
// quaternions, tensors, shapes, gears. Against numbers from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/equations_at.hpp"
#include "extremes/extreme_scenes.hpp"
#include "model/read/read.hpp"
#include "reference/minimal.hpp"

namespace jourdain::tests {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kRounding = 1e-13;
constexpr double kPi = std::numbers::pi;
constexpr double g = 9.81;

reference::VectorX<double> vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}

/// Energies and M by the compiler's equations and by the numeric reference, which must be the same numbers.
EquationsAt by_both(const model::Mechanism& mechanism, const StateNumbers& state) {
  EquationsAt e = equations_at(mechanism, state);
  const auto terms = reference::Reference<double>(mechanism).evaluate(
      {.t = state.t, .y = vector(state.y), .z = vector(state.z)}, vector(state.u));
  EXPECT_NEAR(terms.potential_energy, e.potential_energy, kRounding);
  EXPECT_NEAR(terms.kinetic_energy, e.kinetic_energy, kRounding);
  for (std::size_t i = 0; i < e.M.size(); ++i)
    for (std::size_t j = 0; j < e.M.size(); ++j)
      EXPECT_NEAR(terms.M(Eigen::Index(i), Eigen::Index(j)), e.M[i][j], kRounding);
  return e;
}

model::Mechanism read_urdf(const std::string& text) {
  support::Diagnostics diagnostics("robot.urdf", text);
  const auto mechanism = model::read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism.value_or(model::Mechanism());
}

/// A slide along +z that carries a link whose joint has this origin; the link's centre of mass is at (1, 2, 3)
/// in its frame.
model::Mechanism tilted(const std::string& rpy) {
  return read_urdf(R"(<robot name="tilted"><link name="base"/>
<link name="b"><inertial><origin xyz="1 2 3"/><mass value="2"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j" type="prismatic"><origin xyz="0 0 0" rpy=")" +
                   rpy + R"("/><parent link="base"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>)");
}

// wiki.ros.org/urdf/XML/joint: "roll pitch and yaw … rotated about fixed axes": R = Rz(yaw) Ry(pitch) Rx(roll).
TEST(Conventions, UrdfTurnsAboutFixedAxesRollFirst) {
  const auto height = [](const std::string& rpy) {
    return by_both(tilted(rpy), {{0}, {0}, {0}}).potential_energy / (2 * g);
  };
  EXPECT_NEAR(height("1.5707963267948966 0 0"), 2, kRounding);   // y goes up
  EXPECT_NEAR(height("0 1.5707963267948966 0"), -1, kRounding);  // x goes down
  EXPECT_NEAR(height("0 0 1.5707963267948966"), 3, kRounding);
  EXPECT_NEAR(height("1.5707963267948966 0 1.5707963267948966"), 2,
              kRounding);  // yaw last: y up first, and stays
  EXPECT_NEAR(height("0 1.5707963267948966 1.5707963267948966"), -1, kRounding);
  EXPECT_NEAR(height("1.5707963267948966 1.5707963267948966 0"), -1,
              kRounding);  // x down, whatever rolled before
  // Third row of R: (−sin p, cos p sin r, cos p cos r).
  const double r = 0.3, p = -0.7;
  EXPECT_NEAR(height("0.3 -0.7 1.9"),
              -std::sin(p) + 2 * std::cos(p) * std::sin(r) + 3 * std::cos(p) * std::cos(r), kRounding);
}

// The same file: x axis of the joint frame is the default axis.
TEST(Conventions, UrdfJointsMoveAlongXUnlessTheySayOtherwise) {
  model::Mechanism robot = read_urdf(R"(<robot name="slide"><link name="base"/>
<link name="b"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j" type="prismatic"><origin rpy="0 -1.5707963267948966 0"/><parent link="base"/><child link="b"/></joint></robot>)");
  EXPECT_NEAR(by_both(robot, {{0.5}, {0}, {0}}).potential_energy, 2 * g * 0.5, kRounding);
}

// A dumbbell along (1, 1, 0): two masses of 1 kg at ±(0.3, 0.3, 0). Tensor Ixx = Iyy = 0.18, Izz = 0.36, Ixy =
// −∫x y dm = −0.18.
TEST(Conventions, ProductsOfInertiaAreEntriesOfTheTensor) {
  const std::string toml = "mass = 2\ninertia = { xx = 0.18, yy = 0.18, zz = 0.36, xy = -0.18 }";
  const auto M = [&](const std::string& body, const char* axis) {
    return by_both(one_body(body, std::string("type = \"revolute\"\naxis = ") + axis +
                                      "\n[[actuator]]\njoint = \"j\"\nrotor_inertia = 1"),
                   {{0.4}, {2}, {0}})
               .M[0][0] -
           1;
  };
  EXPECT_NEAR(M(toml, "[1, 1, 0]"), 0, kRounding);      // along the dumbbell
  EXPECT_NEAR(M(toml, "[1, -1, 0]"), 0.36, kRounding);  // across it
}

TEST(Conventions, UrdfProductsOfInertiaAreEntriesOfTheTensor) {
  const auto M = [](const std::string& axis) {
    return by_both(read_urdf(
                       R"(<robot name="dumbbell"><link name="base"/><link name="b"><inertial><mass value="2"/>
<inertia ixx="0.3" ixy="-0.08" ixz="0.03" iyy="0.35" iyz="0.01" izz="0.37"/></inertial></link>
<joint name="j" type="continuous"><parent link="base"/><child link="b"/><axis xyz=")" +
                       axis + R"("/></joint></robot>)"),
                   {{0.4}, {2}, {0}})
        .M[0][0];
  };
  // nᵀ I n with the tensor as written.
  EXPECT_NEAR(M("1 1 0"), (0.3 + 0.35) / 2 - 0.08, kRounding);
  EXPECT_NEAR(M("1 0 1"), (0.3 + 0.37) / 2 + 0.03, kRounding);
  EXPECT_NEAR(M("0 1 1"), (0.35 + 0.37) / 2 + 0.01, kRounding);
}

// A turn by 2 acos(0.8) about y takes x to (0.28, 0, −0.96): w comes first.
TEST(Conventions, OrientationsAreQuaternionsWithTheScalarFirst) {
  const model::Mechanism ball = one_body("mass = 2\ncenter_of_mass = [1, 0, 0]\ninertia = [1, 1, 1]",
                                         "type = \"spherical\"\ninitial_orientation = [0.8, 0, 0.6, 0]");
  const auto start = reference::Reference<double>(ball).initial_state();
  EXPECT_THAT(std::vector<double>(start.y.begin(), start.y.end()), ElementsAre(0.8, 0, 0.6, 0));
  EXPECT_NEAR(by_both(ball, {{0.8, 0, 0.6, 0}, {0, 0, 0}}).potential_energy, 2 * g * -0.96, kRounding);
}

TEST(Conventions, ADegreeIsThatPartOfPi) {
  const model::Mechanism hinge =
      one_body("mass = 2\ncenter_of_mass = [1, 0, 0]",
               "type = \"revolute\"\naxis = [0, -1, 0]\ninitial_position = \"30*deg\"");
  EXPECT_NEAR(reference::Reference<double>(hinge).initial_state().y[0], kPi / 6, kRounding);
  EXPECT_NEAR(by_both(hinge, {{kPi / 6}, {0}}).potential_energy, 2 * g * 0.5, kRounding);
}

// Halliday, Resnick, Walker, Fundamentals of Physics, table 10-2: solid bodies about axes through their centres.
TEST(Conventions, ShapesHaveTheMomentsOfTextbooks) {
  const auto moments = [](const std::string& shape) {
    const model::Body body = one_body("mass = 12\nshape = " + shape, "type = \"free\"").bodies[0];
    return std::vector<double>{body.inertia.xx.constant(), body.inertia.yy.constant(),
                               body.inertia.zz.constant()};
  };
  const auto near = [](double value) { return DoubleNear(value, kRounding); };
  EXPECT_THAT(moments("{ kind = \"box\", size = [1, 2, 3] }"),
              ElementsAre(near(4 + 9), near(1 + 9), near(1 + 4)));  // m/12 (b² + c²)
  EXPECT_THAT(moments("{ kind = \"sphere\", radius = 2 }"),
              ElementsAre(near(19.2), near(19.2), near(19.2)));  // 2/5 m r²
  // m r²/2 along the axis, m r²/4 + m l²/12 across.
  EXPECT_THAT(moments("{ kind = \"cylinder\", radius = 2, length = 3 }"),
              ElementsAre(near(21), near(21), near(24)));
  EXPECT_THAT(moments("{ kind = \"cylinder\", radius = 2, length = 3, axis = \"y\" }"),
              ElementsAre(near(21), near(24), near(21)));
  EXPECT_THAT(moments("{ kind = \"rod\", length = 3, axis = \"x\" }"),
              ElementsAre(near(0), near(9), near(9)));  // m l²/12
}

TEST(Conventions, DensityTimesVolumeIsTheMass) {
  const auto mass = [](const std::string& shape) {
    return one_body("shape = " + shape, "type = \"free\"").bodies[0].mass.constant();
  };
  EXPECT_NEAR(mass("{ kind = \"box\", size = [1, 2, 3], density = 7 }"), 42, kRounding);
  EXPECT_NEAR(mass("{ kind = \"cylinder\", radius = 2, length = 3, density = 7 }"), 84 * kPi, 10 * kRounding);
  EXPECT_NEAR(mass("{ kind = \"sphere\", radius = 3, density = 7 }"), 252 * kPi, 10 * kRounding);
}

TEST(Conventions, AGearTurnsForcesOnceAndInertiaTwice) {
  const EquationsAt e =
      by_both(one_body("mass = 2\ncenter_of_mass = [0.5, 0, 0]", "type = \"revolute\"",
                       "[[actuator]]\njoint = \"j\"\ngear_ratio = 50\nrotor_inertia = 2e-4"),
              {{0.4}, {2}, {3}});
  EXPECT_NEAR(e.M[0][0], 2 * 0.25 + 2500 * 2e-4, kRounding);
  EXPECT_NEAR(e.q_bar[0], -150, kRounding);
}

TEST(Conventions, InertiaAxesAreTurnedByRollPitchYaw) {
  // Roll 90°: the body's z moment is the y moment of the axes.
  const double M = by_both(one_body("mass = 2\ninertia = [1, 2, 2.5]\ninertia_rpy = [\"90*deg\", 0, 0]",
                                    "type = \"revolute\""),
                           {{0.4}, {2}})
                       .M[0][0];
  EXPECT_NEAR(M, 2, kRounding);
}

TEST(Conventions, InertiaAboutTheOriginIsTakenAsSuch) {
  const auto M = [](const char* at) {
    return by_both(
               one_body(std::string(
                            "mass = 2\ncenter_of_mass = [0.5, 0, 0]\ninertia = [1, 2, 2.5]\ninertia_at = ") +
                            at,
                        "type = \"revolute\""),
               {{0.4}, {2}})
        .M[0][0];
  };
  EXPECT_NEAR(M("\"origin\""), 2.5, kRounding);
  EXPECT_NEAR(M("\"center_of_mass\""), 3, kRounding);
}

}  // namespace
}  // namespace jourdain::tests
