// Masses and inertias of MJCF bodies, by hand.
#include <gtest/gtest.h>

#include <numbers>

#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-13;

Body body(const std::string& in_body, const std::string& sections = "") {
  support::Diagnostics diagnostics("m.mjcf", "<mujoco>" + sections +
                                                 "<worldbody><body name=\"b\"><joint name=\"j\"/>" + in_body +
                                                 "</body></worldbody></mujoco>");
  const auto mechanism = read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism ? mechanism->bodies[0] : Body();
}

void expect_moments(const Body& body, double xx, double yy, double zz) {
  EXPECT_NEAR(body.inertia.xx.constant(), xx, kRounding * xx);
  EXPECT_NEAR(body.inertia.yy.constant(), yy, kRounding * yy);
  EXPECT_NEAR(body.inertia.zz.constant(), zz, kRounding * zz);
}

const std::string kInertial = R"(<inertial pos="1 2 3" mass="2" diaginertia="0.3 0.4 0.5"/>)";

TEST(MjcfInertia, FullInertiaHasItsDiagonalFirst) {
  const Body b = body(R"(<inertial pos="0 0 0" mass="2" fullinertia="1 2 2.5 0.1 0.2 0.3"/>)");
  expect_moments(b, 1, 2, 2.5);
  EXPECT_EQ(b.inertia.xy.constant(), 0.1);
  EXPECT_EQ(b.inertia.xz.constant(), 0.2);
  EXPECT_EQ(b.inertia.yz.constant(), 0.3);
}

TEST(MjcfInertia, GeomsCountWhereThereIsNoInertial) {
  const std::string ball = R"(<geom size="0.1"/>)";  // a sphere of water
  const double mass = 1000 * 4 * kPi / 3 * 1e-3;
  EXPECT_NEAR(body(ball).mass.constant(), mass, kRounding * mass);
  EXPECT_EQ(body(kInertial + ball).mass.constant(), 2);
  EXPECT_NEAR(body(kInertial + ball, R"(<compiler inertiafromgeom="true"/>)").mass.constant(), mass,
              kRounding * mass);
  EXPECT_EQ(body(kInertial + ball, R"(<compiler inertiafromgeom="false"/>)").mass.constant(), 2);
  EXPECT_EQ(body(kInertial, R"(<compiler inertiafromgeom="true"/>)").mass.constant(), 2);
  EXPECT_NEAR(
      body(ball + R"(<geom group="3" size="1"/>)", R"(<compiler inertiagrouprange="0 2"/>)").mass.constant(),
      mass, kRounding * mass);
}

TEST(MjcfInertia, EachShapeWeighsAsItShould) {
  // Half sizes; mass 12 kg each.
  expect_moments(body(R"(<geom type="box" size="1 2 3" mass="12"/>)"), 52, 40, 20);
  expect_moments(body(R"(<geom type="sphere" size="2" mass="10"/>)"), 16, 16, 16);
  expect_moments(body(R"(<geom type="ellipsoid" size="1 2 3" mass="5"/>)"), 13, 10, 5);
  expect_moments(body(R"(<geom type="cylinder" size="2 3" mass="12"/>)"), 48, 48, 24);
  // A capsule of radius 3 and straight part 8, density 1/pi: a cylinder of mass 72 and a ball of mass 36. Lateral
  // 72 (9/4 + 16/3) + 36 (2/5 9 + 16 + 3/4 3 4) = 546 + 1029.6, axial 72 9/2 + 36 2/5 9.
  const Body capsule = body(R"(<geom type="capsule" size="3 4" density="0.3183098861837907"/>)");
  EXPECT_NEAR(capsule.mass.constant(), 108, 1e-12);
  expect_moments(capsule, 1575.6, 1575.6, 453.6);
}

TEST(MjcfInertia, ShapesBetweenTwoPointsLieAlongThem) {
  const Body rod = body(R"(<geom type="cylinder" size="2" fromto="-3 1 0 3 1 0" mass="12"/>)");
  EXPECT_NEAR(rod.center_of_mass[1].constant(), 1, kRounding);
  expect_moments(rod, 24, 48, 48);
}

TEST(MjcfInertia, SeveralGeomsAreTakenAboutTheirCommonCentre) {
  // Two balls of 10 kg and radius 2 at x = 1 and x = 5: each 16 about its own centre, 2 m from the common one.
  const Body b = body(R"(<geom size="2" mass="10" pos="1 0 0"/><geom size="2" mass="10" pos="5 0 0"/>)");
  EXPECT_EQ(b.mass.constant(), 20);
  EXPECT_NEAR(b.center_of_mass[0].constant(), 3, kRounding);
  expect_moments(b, 32, 112, 112);
}

TEST(MjcfInertia, ClassesGiveShapesAndPartOfASize) {
  const std::string classes =
      R"(<default><default class="pin"><geom type="cylinder" size="9 3" mass="12"/></default></default>)";
  expect_moments(body(R"(<geom class="pin" size="2"/>)", classes), 48, 48, 24);
}

TEST(MjcfInertia, IsBalancedBoundedAndScaledOnRequest) {
  const std::string flat = R"(<inertial pos="0 0 0" mass="2" diaginertia="0.1 0.2 0.6"/>)";
  expect_moments(body(flat, R"(<compiler balanceinertia="true"/>)"), 0.3, 0.3, 0.3);
  const Body bounded = body(kInertial, R"(<compiler boundmass="3" boundinertia="0.35"/>)");
  EXPECT_EQ(bounded.mass.constant(), 3);
  expect_moments(bounded, 0.35, 0.4, 0.5);
  const Body scaled = body(kInertial, R"(<compiler settotalmass="6"/>)");
  EXPECT_EQ(scaled.mass.constant(), 6);
  expect_moments(scaled, 0.9, 1.2, 1.5);
}

}  // namespace
}  // namespace jourdain::model
