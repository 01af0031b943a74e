#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

constexpr const char* kHeavy =
    R"(<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>)";

/// An arm with two fingers and a thumb; what stands in their joints, and in the links of the fingers.
std::string hand(const std::string& left, const std::string& right, const std::string& thumb = "",
                 const std::string& fingers = kHeavy, const char* left_type = "prismatic") {
  return fmt::format(R"(<robot name="hand">
  <link name="base"/> <link name="arm">{0}</link>
  <link name="l">{1}</link> <link name="r">{1}</link> <link name="t">{1}</link>
  <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/></joint>
  <joint name="left" type="{2}"><parent link="arm"/><child link="l"/>{3}</joint>
  <joint name="right" type="prismatic"><parent link="arm"/><child link="r"/>{4}</joint>
  <joint name="thumb" type="continuous"><parent link="arm"/><child link="t"/>{5}</joint>
</robot>
)",
                     kHeavy, fingers, left_type, left, right, thumb);
}

struct Read {
  Mechanism mechanism;
  std::string diagnostics;

  std::vector<std::string> actuators() const {
    std::vector<std::string> names;
    for (const Actuator& actuator : mechanism.actuators) names.push_back(actuator.name);
    return names;
  }
};

Read read(const std::string& text, const ReadOptions& options = {}) {
  support::Diagnostics diagnostics("hand.urdf", text);
  Mechanism mechanism = read_mechanism(diagnostics, options).value_or(Mechanism());
  return {std::move(mechanism), diagnostics.format()};
}

using Names = std::vector<std::string>;

/// At positions that tell the joints apart: elbow 0.1, left 2, right 30, thumb 400.
double residual(const Loop& loop) {
  return loop.residual.evaluate<double>(
      {}, [](double v) { return v; },
      [](const Variable& v) { return 0.1 * std::pow(10, v.index) * (double(v.index) + 1); });
}

TEST(UrdfMimic, IsACouplerAndTheFollowerTakesNoInput) {
  const Read of = read(hand("", R"(<mimic joint="left" multiplier="-2" offset="0.5"/>)"));
  EXPECT_EQ(of.diagnostics, "");
  ASSERT_EQ(of.mechanism.loops.size(), 1u);
  EXPECT_EQ(of.mechanism.loops[0].name, "right");
  EXPECT_NEAR(residual(of.mechanism.loops[0]), 30 + 2 * 2 - 0.5, 1e-12);
  EXPECT_EQ(of.actuators(), (Names{"elbow", "left", "thumb"}));
  EXPECT_EQ(of.mechanism.joints[2].coordinates[0].initial_position.constant(), 0.5);
}

TEST(UrdfMimic, OfWhatComesLaterAndOfFollowers) {
  const Read of =
      read(hand(R"(<mimic joint="right" multiplier="3"/>)", R"(<mimic joint="thumb" offset="2"/>)"));
  EXPECT_EQ(of.diagnostics, "");
  ASSERT_EQ(of.mechanism.loops.size(), 2u);
  EXPECT_NEAR(residual(of.mechanism.loops[0]), 2 - 3 * 30, 1e-12);
  EXPECT_NEAR(residual(of.mechanism.loops[1]), 30 - 400 - 2, 1e-12);
  EXPECT_EQ(of.mechanism.joints[1].coordinates[0].initial_position.constant(), 6);
  EXPECT_EQ(of.actuators(), (Names{"elbow", "thumb"}));
}

TEST(UrdfMimic, IsLeftOutOnRequest) {
  const Read of = read(hand("", R"(<mimic joint="left"/>)"), {.mimic = false});
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_TRUE(of.mechanism.loops.empty());
  EXPECT_EQ(of.mechanism.actuators.size(), 4u);
}

TEST(UrdfMimic, LocksWithItsLeader) {
  const Read of =
      read(hand("", R"(<mimic joint="left"/>)", R"(<mimic joint="right"/>)"), {.locked_joints = {"left"}});
  EXPECT_TRUE(of.mechanism.loops.empty());
  EXPECT_EQ(moving_joints(of.mechanism).size(), 1u);
  EXPECT_EQ(of.actuators(), Names{"elbow"});
  EXPECT_NE(of.diagnostics.find("note: joint 'thumb' is locked with 'right', which it follows"),
            std::string::npos)
      << of.diagnostics;
}

TEST(UrdfMimic, IsHeldAtItsOffsetFromALockedLeader) {
  const Read of =
      read(hand("", R"(<mimic joint="left" multiplier="2" offset="0.25"/>)"), {.locked_joints = {"left"}});
  EXPECT_EQ(of.diagnostics, "");
  ASSERT_EQ(of.mechanism.loops.size(), 1u);
  EXPECT_NEAR(residual(of.mechanism.loops[0]), 30 - 0.25, 1e-12);
}

TEST(UrdfMimic, IsHeldAtItsOffsetFromAFixedLeader) {
  const Read of =
      read(hand("", R"(<mimic joint="left" multiplier="2" offset="0.25"/>)", "", kHeavy, "fixed"));
  EXPECT_EQ(of.diagnostics, "");
  ASSERT_EQ(of.mechanism.loops.size(), 1u);
  EXPECT_NEAR(residual(of.mechanism.loops[0]), 30 - 0.25, 1e-12);
  EXPECT_EQ(of.mechanism.joints[2].coordinates[0].initial_position.constant(), 0.25);
}

TEST(UrdfMimic, OfALockedFollowerLeavesTheLeaderFree) {
  const Read of = read(hand("", R"(<mimic joint="left"/>)"), {.locked_joints = {"right"}});
  EXPECT_TRUE(of.mechanism.loops.empty());
  EXPECT_EQ(of.actuators(), (Names{"elbow", "left", "thumb"}));
  EXPECT_NE(of.diagnostics.find("note: joint 'right' is locked and does not follow 'left'"),
            std::string::npos)
      << of.diagnostics;
}

TEST(UrdfMimic, FingersWithoutMassAreHeldWithTheirLeader) {
  const Read of = read(hand("", R"(<mimic joint="left"/>)", "", ""));
  EXPECT_EQ(of.mechanism.welded, (Names{"left", "right", "thumb"}));
  EXPECT_TRUE(of.mechanism.loops.empty());
}

TEST(UrdfMimic, FrictionIsTakenOnRequest) {
  const std::string text = hand(R"(<dynamics friction="0.3" damping="2"/>)", "");
  EXPECT_TRUE(read(text).mechanism.joints[1].coordinates[0].friction.is_zero());
  const Read of = read(text, {.friction = true});
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_EQ(of.mechanism.joints[1].coordinates[0].friction.constant(), 0.3);
  EXPECT_EQ(of.mechanism.joints[1].coordinates[0].friction_speed.constant(), 1e-3);
}

}  // namespace
}  // namespace jourdain::model
