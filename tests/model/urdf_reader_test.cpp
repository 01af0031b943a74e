#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "agreement/shared_data.hpp"
#include "model/read/read.hpp"
#include "support/files.hpp"

namespace jourdain::model {
namespace {

const std::string kArm = R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="arm">
    <inertial>
      <origin xyz="0.1 +2e-1 -.3" rpy="0.4 0.5 0.6"/>
      <mass value="2"/>
      <inertia ixx="0.1" ixy="0.01" ixz="0.02" iyy="0.2" iyz="0.03" izz="0.25"/>
    </inertial>
    <visual><geometry><box size="not read"/></geometry></visual>
  </link>
  <link name="finger"><inertial><mass value="0.1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="sensor"/>
  <joint name="elbow" type="continuous">
    <origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>
    <parent link="base"/>
    <child link="arm"/>
    <dynamics damping="0.5" friction="0"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="arm"/>
    <child link="finger"/>
    <axis xyz="0 -1 0"/>
  </joint>
  <joint name="mount" type="fixed">
    <parent link="finger"/>
    <child link="sensor"/>
    <axis xyz="0 0 0"/>
    <mimic joint="slide"/>
  </joint>
  <gazebo><anything deep="1"/></gazebo>
</robot>
)";

Mechanism read_cleanly(const std::string& text, const ReadOptions& options = {}) {
  support::Diagnostics diagnostics("arm.urdf", text);
  auto mechanism = read_mechanism(diagnostics, options);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism.value_or(Mechanism());
}

TEST(ReadUrdf, TakesLinks) {
  const Mechanism m = read_cleanly(kArm);
  EXPECT_EQ(m.name, "arm");
  EXPECT_EQ(m.gravity[2].constant(), -9.81);
  ASSERT_EQ(m.bodies.size(), 4u);
  EXPECT_TRUE(m.bodies[0].mass.is_zero());
  const Body& arm = m.bodies[1];
  EXPECT_EQ(arm.mass.constant(), 2);
  EXPECT_EQ(arm.center_of_mass[1].constant(), 0.2);
  EXPECT_EQ(arm.center_of_mass[2].constant(), -0.3);
  EXPECT_EQ(arm.inertia_axes.rpy[2].constant(), 0.6);
  EXPECT_EQ(arm.inertia.yy.constant(), 0.2);
  EXPECT_EQ(arm.inertia.xz.constant(), 0.02);
  EXPECT_EQ(arm.inertia.yz.constant(), 0.03);
  EXPECT_EQ(arm.where.line, 4);
}

TEST(ReadUrdf, TakesJointsAndActuatesThoseThatMove) {
  const Mechanism m = read_cleanly(kArm);
  ASSERT_EQ(m.joints.size(), 4u);
  EXPECT_EQ(m.joints[0].type, JointType::kRevolute);
  EXPECT_EQ(m.joints[0].axis, (std::array<double, 3>{1, 0, 0}));
  EXPECT_EQ(m.joints[0].placement.position[2].constant(), 3);
  EXPECT_EQ(m.joints[0].placement.rotation.rpy[0].constant(), 0.1);
  EXPECT_EQ(m.joints[0].coordinates[0].damping.constant(), 0.5);
  EXPECT_EQ(m.joints[1].type, JointType::kPrismatic);
  EXPECT_EQ(m.joints[1].axis, (std::array<double, 3>{0, -1, 0}));
  EXPECT_EQ(m.joints[2].type, JointType::kFixed);
  ASSERT_EQ(m.actuators.size(), 2u);
  EXPECT_EQ(m.actuators[1].name, "slide");
  EXPECT_EQ(m.actuators[1].joint, JointIndex(1));
}

TEST(ReadUrdf, FixesTheRootToTheWorld) {
  const Mechanism m = read_cleanly(kArm);
  const Joint& root = m.joints[3];
  EXPECT_EQ(root.name, "base_to_world");
  EXPECT_EQ(root.type, JointType::kFixed);
  EXPECT_FALSE(root.parent.has_value());
  EXPECT_EQ(root.child, BodyIndex(0));
}

TEST(ReadUrdf, LeavesDampingOutOnRequest) {
  EXPECT_TRUE(read_cleanly(kArm, {.damping = false}).joints[0].coordinates[0].damping.is_zero());
}

TEST(ReadUrdf, PutsTheRootOnAFreeJoint) {
  const Mechanism m = read_cleanly(kArm, {.root = RootJoint::kFree});
  const JointIndex first = depth_first(m).front();
  EXPECT_EQ(m.joints[first.value].type, JointType::kFree);
  EXPECT_EQ(m.joints[first.value].name, "root");
  EXPECT_FALSE(m.joints[first.value].parent);
  EXPECT_EQ(m.actuators.size(), 2u);
}

TEST(ReadUrdf, ReadsPlanarJointsAndFloatingOnesOnTheRoot) {
  const auto robot = [](const std::string& type) {
    return "<robot name='r'><link name='base'/><link name='b'><inertial><mass value='1'/>"
           "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
           "<joint name='j' type='" +
           type + "'><parent link='base'/><child link='b'/><axis xyz='0 0 1'/></joint></robot>";
  };
  const Mechanism planar = read_cleanly(robot("planar"));
  EXPECT_EQ(planar.joints[0].type, JointType::kPlanar);
  EXPECT_EQ(planar.joints[0].coordinates.size(), 3u);
  EXPECT_TRUE(planar.actuators.empty());
  const Mechanism floating = read_cleanly(robot("floating"));
  EXPECT_EQ(floating.joints[0].type, JointType::kFree);
  EXPECT_FALSE(floating.joints[0].parent);
}

/// 0.6 rad about z: half of it in the quaternion.
TEST(ReadUrdf, FloatingJointsStartAtTheirOrigin) {
  const Mechanism m = read_cleanly(
      "<robot name='r'><link name='world'/><link name='b'><inertial><mass value='1'/><inertia ixx='1' "
      "iyy='1' izz='1' "
      "ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='j' type='floating'><origin xyz='1 2 3' rpy='0 "
      "0 0.6'/>"
      "<parent link='world'/><child link='b'/></joint></robot>");
  EXPECT_FALSE(m.joints[0].parent);
  for (const std::size_t k : {0u, 1u, 2u}) EXPECT_EQ(m.joints[0].initial_origin[k].constant(), double(k + 1));
  EXPECT_NEAR(m.joints[0].initial_orientation[0].constant(), std::cos(0.3), 1e-15);
  EXPECT_NEAR(m.joints[0].initial_orientation[3].constant(), std::sin(0.3), 1e-15);
  EXPECT_TRUE(m.joints[0].placement.position[0].is_zero());
}

TEST(ReadUrdf, OriginsMayHaveQuaternions) {
  const auto text = [](const std::string& attributes) {
    return "<robot name='r'><link name='a'/><link name='b'><inertial><origin " + attributes +
           "/><mass value='1'/><inertia ixx='1' iyy='2' izz='2.5' ixy='0' ixz='0' "
           "iyz='0'/></inertial></link><joint name='j' "
           "type='continuous'><origin xyz='0 0 1' " +
           attributes + "/><parent link='a'/><child link='b'/></joint></robot>";
  };
  const Mechanism m = read_cleanly(text("quat_xyzw='0 0 0.6 0.8'"));
  for (const Rotation& turned : {m.joints[0].placement.rotation, m.bodies[1].inertia_axes}) {
    EXPECT_NEAR(turned.rpy[0].constant(), 0, 1e-15);
    EXPECT_NEAR(turned.rpy[2].constant(), 2 * std::atan2(0.6, 0.8), 1e-15);
  }
  for (const auto& [attributes, message] :
       {std::pair("quat_xyzw='0 0 0 0'", "the quaternion of <origin> is zero"),
        std::pair("quat_xyzw='0 0 1'", "'quat_xyzw' of <origin> needs 4 numbers, found 3"),
        std::pair("quat_xyzw='0 0 1 x'", "x"),
        std::pair("quat_xyzw='0 0 1 0' rpy='0 0 0'", "<origin> has 'rpy' and 'quat_xyzw'")}) {
    support::Diagnostics diagnostics("arm.urdf", text(attributes));
    EXPECT_FALSE(read_mechanism(diagnostics)) << attributes;
    EXPECT_NE(diagnostics.format().find(message), std::string::npos) << diagnostics.format();
  }
}

TEST(ReadUrdf, LocksJoints) {
  const Mechanism m = read_cleanly(kArm, {.locked_joints = {"slide"}});
  EXPECT_EQ(m.joints[1].type, JointType::kFixed);
  ASSERT_EQ(m.actuators.size(), 1u);
  EXPECT_EQ(m.actuators[0].name, "elbow");
}

/// A robot and its degrees of freedom.
struct Robot {
  const char* name;
  std::size_t degrees_of_freedom;
};

/// The strings of the JSON list that begins behind `mark`.
std::vector<std::string> quoted_words(const std::string& json, const std::string& mark) {
  const std::size_t begin = json.find(mark) + mark.size();
  const std::string list = json.substr(begin, json.find(']', begin) - begin);
  std::vector<std::string> words;
  for (std::size_t open = list.find('"'); open != std::string::npos;) {
    const std::size_t close = list.find('"', open + 1);
    words.push_back(list.substr(open + 1, close - open - 1));
    open = list.find('"', close + 1);
  }
  return words;
}

TEST(ReadUrdf, RobotsGiveNoErrorsAndTheJointsOfTheirAccelerations) {
  const Robot robots[] = {{"rail_arm", 6}, {"biped", 15}, {"double_pendulum", 2}, {"ur5", 6},
                          {"panda", 9},    {"hyq", 12},   {"talos_reduced", 32}};
  for (const Robot& robot : robots) {
    if (!tests::has_robot(robot.name)) continue;
    const std::string path = tests::urdf_path(robot.name).string();
    support::Diagnostics diagnostics(path, support::read_file(path));
    const auto mechanism = read_mechanism(diagnostics);
    ASSERT_TRUE(mechanism.has_value()) << diagnostics.format();
    // The accelerations name the same joints; the order of siblings may differ.
    std::vector<std::string> names;
    for (const JointIndex joint : moving_joints(*mechanism))
      names.push_back(mechanism->joints[joint.value].name);
    EXPECT_EQ(names.size(), robot.degrees_of_freedom) << robot.name;
    std::vector<std::string> expected = quoted_words(
        support::read_file(tests::accelerations_path(robot.name, "fixed").string()), "\"joints\": [");
    std::sort(names.begin(), names.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(names, expected);
  }
}

}  // namespace
}  // namespace jourdain::model
