#include "model/read/weld.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

constexpr const char* kHeavy =
    R"(<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>)";

/// An arm with two fingers, the second with a tip; `tip` and `inside` are put into that link and into the
/// joint that carries it.
std::string hand(const std::string& tip = "", const std::string& inside = "") {
  return fmt::format(R"(<robot name="hand">
  <link name="base"/> <link name="arm">{}</link>
  <link name="left"/> <link name="right"/> <link name="tip">{}</link>
  <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/></joint>
  <joint name="left_joint" type="prismatic"><parent link="arm"/><child link="left"/></joint>
  <joint name="right_joint" type="prismatic"><parent link="arm"/><child link="right"/></joint>
  <joint name="tip_joint" type="continuous"><parent link="right"/><child link="tip"/>{}</joint>
</robot>
)",
                     kHeavy, tip, inside);
}

struct Read {
  Mechanism mechanism;
  std::string diagnostics;
};

Read read(const std::string& path, const std::string& text) {
  support::Diagnostics diagnostics(path, text);
  Mechanism mechanism = read_mechanism(diagnostics).value_or(Mechanism());
  return {std::move(mechanism), diagnostics.format()};
}

using Names = std::vector<std::string>;

TEST(Weld, HoldsFingersWithoutMass) {
  const Read of = read("hand.urdf", hand());
  EXPECT_EQ(of.mechanism.welded, (Names{"left_joint", "right_joint", "tip_joint"}));
  EXPECT_EQ(moving_joints(of.mechanism).size(), 1u);
  EXPECT_EQ(of.mechanism.actuators.size(), 1u);
  EXPECT_NE(of.diagnostics.find(
                "warning: no mass is beyond joints 'left_joint', 'right_joint', 'tip_joint': held at zero"),
            std::string::npos)
      << of.diagnostics;
}

TEST(Weld, MassAtTheTipMovesAllBeforeIt) {
  EXPECT_EQ(read("hand.urdf", hand(kHeavy)).mechanism.welded, Names{"left_joint"});
}

TEST(Weld, JointsThatFollowWhatMovesAreLeftAlone) {
  EXPECT_EQ(read("hand.urdf", hand("", R"(<mimic joint="elbow"/>)")).mechanism.welded, Names{"left_joint"});
}

TEST(Weld, DoesNothingWhereNoJointWouldBeLeft) {
  const Read of = read("bare.urdf", R"(<robot name="bare">
  <link name="base"/><link name="arm"/>
  <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/></joint>
</robot>)");
  EXPECT_TRUE(of.mechanism.welded.empty());
  EXPECT_EQ(of.diagnostics, "");
}

/// A pendulum with a pointer without mass, and more lines.
std::string pointer(const std::string& more, const std::string& joint = "") {
  return R"([model]
name = "pointer"
[[body]]
name = "bob"
mass = 1
center_of_mass = [0, 0, -1]
[[body]]
name = "hand"
mass = 0
[[joint]]
name = "hinge"
type = "revolute"
parent = "world"
child = "bob"
axis = [0, 1, 0]
[[joint]]
name = "turn"
type = "revolute"
parent = "bob"
child = "hand"
axis = [0, 0, 1]
)" + joint +
         more;
}

TEST(Weld, AnythingThatActsOnTheJointOrNamesItKeepsIt) {
  EXPECT_EQ(read("p.toml", pointer("")).mechanism.welded, Names{"turn"});
  const Names joints = {"stiffness = 1\n", "initial_position = 0.1\n", "initial_velocity = 0.1\n",
                        "motion = \"t\"\n"};
  for (const std::string& joint : joints) {
    const Read of = read("p.toml", pointer("", joint));
    EXPECT_FALSE(of.mechanism.bodies.empty()) << joint << of.diagnostics;
    EXPECT_TRUE(of.mechanism.welded.empty()) << joint;
  }
  const Names others = {"[[actuator]]\nname = \"motor\"\njoint = \"turn\"\n",
                        "[[force]]\nname = \"f\"\njoint = \"turn\"\nvalue = 1\n",
                        "[[frame]]\nname = \"end\"\nbody = \"hand\"\n",
                        "[[output]]\nname = \"angle\"\nkind = \"expression\"\nvalue = \"turn\"\n",
                        "[[output]]\nname = \"r\"\nkind = \"reaction\"\njoint = \"turn\"\n"};
  for (const std::string& other : others) {
    const Read of = read("p.toml", pointer(other));
    EXPECT_FALSE(of.mechanism.bodies.empty()) << other << of.diagnostics;
    EXPECT_TRUE(of.mechanism.welded.empty()) << other;
  }
}

}  // namespace
}  // namespace jourdain::model
