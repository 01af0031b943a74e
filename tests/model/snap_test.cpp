#include "model/snap.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

/// A pendulum whose hinge is placed with these angles and turns about this axis.
std::string pendulum(const std::string& rpy, const std::string& axis) {
  return fmt::format(R"(<robot name="pendulum">
  <link name="base"/>
  <link name="bob"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="hinge" type="continuous">
    <origin rpy="{}"/>
    <parent link="base"/>
    <child link="bob"/>
    <axis xyz="{}"/>
  </joint>
</robot>
)",
                     rpy, axis);
}

struct Read {
  Mechanism mechanism;
  std::string diagnostics;
};

Read read(const std::string& rpy, const std::string& axis = "0 0 1", double snap = kDefaultSnap) {
  support::Diagnostics diagnostics("pendulum.urdf", pendulum(rpy, axis));
  ReadOptions options;
  options.snap = snap;
  Mechanism mechanism = read_mechanism(diagnostics, options).value();
  return {std::move(mechanism), diagnostics.format()};
}

std::array<double, 3> angles(const Mechanism& mechanism) {
  const Vector3& rpy = mechanism.joints[0].placement.rotation.rpy;
  return {rpy[0].constant(), rpy[1].constant(), rpy[2].constant()};
}

using Triple = std::array<double, 3>;
constexpr double kQuarter = 1.5707963267948966;

TEST(Snap, RightAnglesOfFourDecimalsAreExact) {
  const Read of = read("1.5708 -3.1416 4.7124");
  EXPECT_EQ(angles(of.mechanism), (Triple{kQuarter, -3.141592653589793, 4.71238898038469}));
  EXPECT_NE(of.diagnostics.find(
                "pendulum.urdf:5:18: note: 3 angles within 2e-05 rad of a right angle read as exact"),
            std::string::npos)
      << of.diagnostics;
  EXPECT_NE(of.diagnostics.find("--no-snap"), std::string::npos);
}

TEST(Snap, OtherAnglesStay) {
  EXPECT_EQ(angles(read("1.5707 0.7854 1.57").mechanism), (Triple{1.5707, 0.7854, 1.57}));
  EXPECT_EQ(angles(read("1.5708 0 0", "0 0 1", 1e-6).mechanism)[0], 1.5708);
  EXPECT_EQ(angles(read("1.57 0 0", "0 0 1", 1e-3).mechanism)[0], kQuarter);
}

TEST(Snap, ZeroTakesAllAsItIs) {
  const Read of = read("1.5708 0 1e-7", "1 0 6.123e-17", 0);
  EXPECT_EQ(angles(of.mechanism), (Triple{1.5708, 0, 1e-7}));
  EXPECT_EQ(of.mechanism.joints[0].axis, (Triple{1, 0, 6.123e-17}));
  EXPECT_FALSE(of.mechanism.snap);
  EXPECT_EQ(of.diagnostics, "");
}

TEST(Snap, RoundingAloneIsNotWorthANote) {
  const Read of = read("1.5707963267948966 -1.5707963267948968 0", "1 0 6.123e-17");
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_TRUE(of.mechanism.snapped.empty());
  EXPECT_EQ(of.mechanism.joints[0].axis, (Triple{1, 0, 0}));
}

TEST(Snap, AxesLieOnAxesAndPlanesOfTheFrameWhereNear) {
  const Read of = read("0 0 0", "0 -0.99999 0.00001");
  EXPECT_EQ(of.mechanism.joints[0].axis, (Triple{0, -0.99999, 0}));
  EXPECT_NE(of.diagnostics.find("note: 1 axis within"), std::string::npos) << of.diagnostics;
  EXPECT_EQ(read("0 0 0", "0.6 0.8 0.00001").mechanism.joints[0].axis, (Triple{0.6, 0.8, 0}));
}

/// A bar of 0.1 m about its middle, 1 kg, with this place of its hinge, centre of mass and product of inertia.
Mechanism bar(const std::string& place, const std::string& center, const std::string& product, double snap) {
  const std::string text = fmt::format(R"(<robot name="bar">
  <link name="base"/>
  <link name="bar"><inertial><origin xyz="{}"/><mass value="1"/>
    <inertia ixx="0.01" ixy="{}" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="hinge" type="continuous">
    <origin xyz="{}"/>
    <parent link="base"/>
    <child link="bar"/>
  </joint>
</robot>
)",
                                       center, product, place);
  support::Diagnostics diagnostics("bar.urdf", text);
  ReadOptions options;
  options.snap = snap;
  Mechanism mechanism = read_mechanism(diagnostics, options).value();
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism;
}

Triple numbers(const Vector3& vector) {
  return {vector[0].constant(), vector[1].constant(), vector[2].constant()};
}

TEST(Snap, LengthsAndProductsThatAreRoundingOfTheSizeAreZero) {
  const auto place = [](const Mechanism& m) { return numbers(m.joints[0].placement.position); };
  const Mechanism dust = bar("0.3 -9e-17 2e-51", "9e-17 0.02 -1e-16", "9e-18", kDefaultSnap);
  EXPECT_EQ(place(dust), (Triple{0.3, 0, 0}));
  EXPECT_EQ(numbers(dust.bodies.back().center_of_mass), (Triple{0, 0.02, 0}));
  EXPECT_EQ(dust.bodies.back().inertia.xy.constant(), 0);
  const Mechanism meant = bar("0.3 -1.1e-16 0", "0 1.1e-16 0", "1.1e-17", kDefaultSnap);
  EXPECT_EQ(place(meant), (Triple{0.3, -1.1e-16, 0}));
  EXPECT_EQ(numbers(meant.bodies.back().center_of_mass)[1], 1.1e-16);
  EXPECT_NE(meant.bodies.back().inertia.xy.constant(), 0);
  EXPECT_EQ(place(bar("0.3 -9e-17 0", "0 0 0", "0", 0)), (Triple{0.3, -9e-17, 0}));
}

TEST(Snap, LengthsStayWhereNoBodyHasASize) {
  support::Diagnostics diagnostics("point.toml", R"([model]
name = "point"
[[body]]
name = "bob"
mass = 1.0
center_of_mass = [0.0, 0.0, 1e-20]
[[joint]]
name = "hinge"
type = "revolute"
parent = "world"
child = "bob"
axis = [0.0, 1.0, 0.0]
)");
  const std::optional<Mechanism> mechanism = read_mechanism(diagnostics, {});
  ASSERT_TRUE(mechanism) << diagnostics.format();
  EXPECT_EQ(mechanism->bodies.back().center_of_mass[2].constant(), 1e-20);
}

TEST(Snap, IsUndone) {
  const Read of = read("1.5708 0 0.3", "0 1e-6 1");
  const Mechanism before = with_directions_as_read(of.mechanism);
  EXPECT_EQ(angles(before), (Triple{1.5708, 0, 0.3}));
  EXPECT_EQ(before.joints[0].axis, (Triple{0, 1e-6, 1}));
  EXPECT_FALSE(before.snap);
  EXPECT_TRUE(before.snapped.empty());
}

}  // namespace
}  // namespace jourdain::model
