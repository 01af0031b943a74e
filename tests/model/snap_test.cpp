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
