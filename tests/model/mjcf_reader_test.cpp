// The rules of MJCF one by one; the numbers follow from MuJoCo's XML reference by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/matrix3.hpp"
#include "model/read/read.hpp"
#include "reference/minimal.hpp"

namespace jourdain::model {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-14;
constexpr double kGravity = 9.81;

struct Read {
  std::optional<Mechanism> mechanism;
  std::string messages;
};

Read read(const std::string& text, const ReadOptions& options = {}) {
  support::Diagnostics diagnostics("m.mjcf", text);
  Read result{read_mechanism(diagnostics, options), ""};
  result.messages = diagnostics.format();
  return result;
}

Mechanism read_cleanly(const std::string& text, const ReadOptions& options = {}) {
  Read result = read(text, options);
  EXPECT_EQ(result.messages, "");
  return result.mechanism.value_or(Mechanism());
}

const std::string kInertial = R"(<inertial pos="0 0 0" mass="2" diaginertia="0.3 0.4 0.5"/>)";

/// One body with these elements, behind these sections.
std::string one_body(const std::string& in_body, const std::string& sections = "",
                     const std::string& attributes = "") {
  return "<mujoco>" + sections + "<worldbody><body name=\"b\" " + attributes + ">" + in_body +
         "</body></worldbody></mujoco>";
}

std::string hinge(const std::string& attributes) {
  return "<joint name=\"j\" " + attributes + "/>" + kInertial;
}

Matrix3 rotation(const Placement& placement) {
  const Vector3& rpy = placement.rotation.rpy;
  return rotation_from_rpy({rpy[0].constant(), rpy[1].constant(), rpy[2].constant()});
}

void expect_axes(const Placement& placement, const Numbers3& x, const Numbers3& y) {
  const Matrix3 R = rotation(placement);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(R[i][0], x[i], kRounding) << "x, entry " << i;
    EXPECT_NEAR(R[i][1], y[i], kRounding) << "y, entry " << i;
  }
}

/// M and q̄ of a mechanism with one coordinate.
reference::Terms<double> terms(const Mechanism& mechanism, double y, double z = 0, double u = 0) {
  const reference::Reference<double> numbers(mechanism);
  const auto inputs = Eigen::Index(numbers.input_count());
  return numbers.evaluate({.t = 0,
                           .y = reference::VectorX<double>::Constant(1, y),
                           .z = reference::VectorX<double>::Constant(1, z)},
                          reference::VectorX<double>::Constant(inputs, u));
}

TEST(ReadMjcf, TellsItselfByItsFirstElement) {
  const std::string text = "<!-- <robot> -->\n" + one_body(hinge(""));
  support::Diagnostics diagnostics("m.xml", text);
  EXPECT_TRUE(read_mechanism(diagnostics));
  support::Diagnostics robot("m.xml", "<robot name=\"r\"/>");
  EXPECT_FALSE(read_mechanism(robot));
  EXPECT_EQ(robot.format().find("mujoco"), std::string::npos);
}

TEST(ReadMjcf, TakesNameAndGravity) {
  const Mechanism plain = read_cleanly(one_body(hinge("")));
  EXPECT_EQ(plain.name, "MuJoCo Model");
  EXPECT_EQ(plain.gravity[2].constant(), -kGravity);
  const Mechanism m =
      read_cleanly("<mujoco model=\"arm\"><option timestep=\"1\"/><option gravity=\"1 2 3\"/>" +
                   one_body(hinge("")).substr(8));
  EXPECT_EQ(m.name, "arm");
  EXPECT_EQ(m.gravity[1].constant(), 2);
  EXPECT_TRUE(read_cleanly(one_body(hinge(""), R"(<option><flag gravity="disable"/></option>)"))
                  .gravity[2]
                  .is_zero());
}

TEST(ReadMjcf, AnglesAreDegreesUnlessTheyAreRadians) {
  const std::string joint = hinge(R"(ref="90" springref="-45" stiffness="2" range="-10 180")");
  const Coordinate degrees = read_cleanly(one_body(joint)).joints[0].coordinates[0];
  EXPECT_NEAR(degrees.initial_position.constant(), kPi / 2, kRounding);
  EXPECT_NEAR(degrees.rest.constant(), -kPi / 4, kRounding);
  EXPECT_NEAR((*degrees.range)[1], kPi, kRounding);
  const std::string small = hinge(R"(ref="0.5" springref="-0.25" stiffness="2" range="-1 2")");
  const Coordinate radians =
      read_cleanly(one_body(small, R"(<compiler angle="radian"/>)")).joints[0].coordinates[0];
  EXPECT_EQ(radians.initial_position.constant(), 0.5);
  EXPECT_EQ(radians.rest.constant(), -0.25);
  EXPECT_EQ((*radians.range)[1], 2);
  const Coordinate slide =
      read_cleanly(one_body(hinge(R"(type="slide" ref="0.1" range="0 0.2")"))).joints[0].coordinates[0];
  EXPECT_EQ(slide.initial_position.constant(), 0.1);
  EXPECT_EQ((*slide.range)[1], 0.2);
}

TEST(ReadMjcf, ReadsEachSpellingOfAnOrientation) {
  const auto placed = [](const std::string& attribute, const std::string& sections = "") {
    return read_cleanly(one_body(hinge(""), sections, attribute)).joints[0].placement;
  };
  const Numbers3 x{1, 0, 0}, y{0, 1, 0}, back{-1, 0, 0}, down{0, 0, -1};
  expect_axes(placed(R"(quat="2 0 0 2")"), y, back);  // not of unit length
  expect_axes(placed(R"(axisangle="0 0 3 90")"), y, back);
  expect_axes(placed(R"(euler="0 0 90")"), y, back);
  expect_axes(placed(R"(xyaxes="0 2 0 -1 5 0")"), y, back);  // y made orthogonal to x
  expect_axes(placed(R"(zaxis="4 0 0")"), down, y);
  expect_axes(placed(R"(zaxis="0 0 -1")"), x, {0, -1, 0});  // half a turn about x
  // Rx(90) Ry(90) takes x to y; Ry(90) Rx(90) takes x to -z and y to x.
  expect_axes(placed(R"(euler="90 90 0")"), y, {0, 0, 1});
  expect_axes(placed(R"(euler="90 90 0")", R"(<compiler eulerseq="XYZ"/>)"), down, x);
  expect_axes(placed(R"(euler="0 90 90")", R"(<compiler eulerseq="zyx"/>)"), down, x);
}

TEST(ReadMjcf, KeepsTheFrameOfABodyWhoseJointIsElsewhere) {
  // A point mass 2 m from the hinge, which is drawn at rest along z.
  const Mechanism m = read_cleanly(one_body(
      R"(<joint name="j" axis="0 1 0" pos="0 0 2"/><inertial pos="0 0 0" mass="3" diaginertia="1 1 1"/>
                  <site name="s" pos="0 0 -1"/>)",
      "", R"(pos="0 0 5")"));
  EXPECT_NEAR(terms(m, 0).M(0, 0), 1 + 3 * 4, kRounding);
  // Turned by a quarter: a moment of 3 g 2 about y, z = 7 the hinge; x of what hung below it is -2 and -3.
  EXPECT_NEAR(std::abs(terms(m, kPi / 2).q_bar[0]), 6 * kGravity, 1e-13);
  const reference::Reference<double> numbers(m);
  const reference::State<double> turned{.t = 0,
                                        .y = reference::VectorX<double>::Constant(1, kPi / 2),
                                        .z = reference::VectorX<double>::Zero(1)};
  EXPECT_NEAR(numbers.frame_motion(turned)[0].p_WC[0], -3, kRounding);
  EXPECT_NEAR(numbers.frame_motion(turned)[0].p_WC[2], 7, kRounding);
  EXPECT_EQ(m.frames[0].body, BodyIndex(0));
}

TEST(ReadMjcf, DrawsTheMechanismWhereTheCoordinateIsItsReference) {
  const Mechanism m = read_cleanly(one_body(R"(<joint name="j" axis="0 2 0" ref="30"/>
      <inertial pos="1 0 0" mass="1" diaginertia="0 0 0"/>)"));
  const reference::Reference<double> numbers(m);
  const auto at = [&](double y) {
    const reference::State<double> state{
        .t = 0, .y = reference::VectorX<double>::Constant(1, y), .z = reference::VectorX<double>::Zero(1)};
    return reference::Vector3<double>(numbers.motion(state)[0].p_WC);
  };
  EXPECT_NEAR(at(kPi / 6)[0], 1, kRounding);
  EXPECT_NEAR(at(2 * kPi / 3)[2], -1, kRounding);  // a quarter further: about y, x goes to -z
  EXPECT_NEAR(numbers.initial_state().y[0], kPi / 6, kRounding);
  const Mechanism slide =
      read_cleanly(one_body(R"(<joint name="j" type="slide" axis="0 0 2" ref="0.25"/>)" + kInertial));
  EXPECT_NEAR(slide.joints[0].placement.position[2].constant(), -0.25, kRounding);
}

TEST(ReadMjcf, ReadsSeveralJointsOfABodyInOrder) {
  const Mechanism m = read_cleanly(one_body(
      R"(<joint name="x" type="slide" axis="1 0 0"/><joint name="turn" axis="0 0 1"/><joint name="ball" type="ball"/>)" +
      kInertial));
  ASSERT_EQ(m.joints.size(), 3u);
  EXPECT_EQ(m.joints[0].type, JointType::kPrismatic);
  EXPECT_EQ(m.joints[1].type, JointType::kRevolute);
  EXPECT_EQ(m.joints[2].type, JointType::kSpherical);
  EXPECT_FALSE(m.joints[0].parent);
  EXPECT_EQ(m.joints[1].parent, m.joints[0].child);
  EXPECT_EQ(m.joints[2].parent, m.joints[1].child);
  EXPECT_EQ(m.bodies[m.joints[2].child.value].name, "b");
  EXPECT_TRUE(m.bodies[m.joints[0].child.value].mass.is_zero());
}

TEST(ReadMjcf, FixesBodiesWithoutJointsAndFreesRoots) {
  const Mechanism m = read_cleanly(R"(<mujoco><worldbody>
    <body name="still"><body name="moving"><joint name="j"/>)" +
                                   kInertial + R"(</body></body>
    <body name="bird" pos="1 2 3" quat="0 0 0 5"><freejoint/>)" +
                                   kInertial + "</body></worldbody></mujoco>");
  ASSERT_EQ(m.joints.size(), 3u);
  EXPECT_EQ(m.joints[0].type, JointType::kFixed);
  const Joint& free = m.joints[2];
  EXPECT_EQ(free.type, JointType::kFree);
  EXPECT_EQ(free.name, "bird");
  EXPECT_EQ(free.initial_origin[2].constant(), 3);
  EXPECT_NEAR(free.initial_orientation[3].constant(), 1, kRounding);
  EXPECT_TRUE(free.placement.position[0].is_zero());
}

TEST(ReadMjcf, PutsWhatIsInAFrameWhereThatIs) {
  const Mechanism m = read_cleanly(
      "<mujoco><worldbody><frame pos=\"0 0 1\" euler=\"0 0 90\"><body name=\"b\" "
      "pos=\"2 0 0\"><joint name=\"j\"/>" +
      kInertial +
      "<frame pos=\"0 1 0\"><site name=\"s\" pos=\"3 0 0\"/></frame></body></frame>"
      "</worldbody></mujoco>");
  EXPECT_NEAR(m.joints[0].placement.position[1].constant(), 2, kRounding);
  EXPECT_NEAR(m.joints[0].placement.position[2].constant(), 1, kRounding);
  expect_axes(m.joints[0].placement, {0, 1, 0}, {-1, 0, 0});
  EXPECT_EQ(m.frames[0].placement.position[0].constant(), 3);
  EXPECT_EQ(m.frames[0].placement.position[1].constant(), 1);
}

TEST(ReadMjcf, LimitsByRangeUnlessItSaysOtherwise) {
  const auto range = [](const std::string& attributes, const std::string& sections = "") {
    return read(one_body(hinge(attributes), sections)).mechanism->joints[0].coordinates[0].range.has_value();
  };
  const std::string strict = R"(<compiler autolimits="false"/>)";
  EXPECT_TRUE(range(R"(range="-1 1")"));
  EXPECT_TRUE(range(R"(range="-1 1" limited="auto")"));
  EXPECT_FALSE(range(R"(range="-1 1" limited="false")"));
  EXPECT_TRUE(range(R"(range="-1 1" limited="true")", strict));
  EXPECT_FALSE(range(R"(range="-1 1")", strict));
  EXPECT_NE(read(one_body(hinge(R"(range="-1 1")"), strict)).messages.find("autolimits is false"),
            std::string::npos);
  EXPECT_NE(read(one_body(hinge(R"(range="10 20")"))).messages.find("outside its range"), std::string::npos);
  EXPECT_FALSE(range(R"(range="10 20")"));
}

TEST(ReadMjcf, TakesWhatIsNotGivenFromTheClass) {
  const Mechanism m =
      read_cleanly(R"(<mujoco><default><joint damping="1" stiffness="2"/>
      <default class="outer"><joint damping="3" axis="0 1 0"/>
        <default class="inner"><joint stiffness="5"/></default></default></default>
    <worldbody><body name="a"><joint name="main"/>)" +
                   kInertial + R"(<body name="b" childclass="outer"><joint name="child"/>)" + kInertial +
                   R"(<body name="c"><joint name="own" class="inner" damping="7"/>)" + kInertial +
                   R"(<body name="d" childclass="inner"><joint name="again" class="main"/>)" + kInertial +
                   "</body></body></body></body></worldbody></mujoco>");
  const auto check = [&](std::size_t j, double damping, double stiffness, double y) {
    EXPECT_EQ(m.joints[j].coordinates[0].damping.constant(), damping) << m.joints[j].name;
    EXPECT_EQ(m.joints[j].coordinates[0].stiffness.constant(), stiffness) << m.joints[j].name;
    EXPECT_EQ(m.joints[j].axis[1], y) << m.joints[j].name;
  };
  check(0, 1, 2, 0);
  check(1, 3, 2, 1);
  check(2, 7, 5, 1);
  check(3, 1, 2, 0);
}

TEST(ReadMjcf, StartsAtTheKeyframeHome) {
  const std::string keys =
      R"(<keyframe><key name="other" qpos="9"/><key name="home" qpos="0.5" qvel="2"/></keyframe>)";
  const Coordinate coordinate = read_cleanly(one_body(hinge(""), keys)).joints[0].coordinates[0];
  EXPECT_EQ(coordinate.initial_position.constant(), 0.5);
  EXPECT_EQ(coordinate.initial_velocity.constant(), 2);
  EXPECT_NE(read(one_body(hinge(""), R"(<keyframe><key name="home" qpos="1 2"/></keyframe>)"))
                .messages.find("'qpos' of <key> needs 1 number, found 2"),
            std::string::npos);
  const Joint free =
      read_cleanly(
          one_body("<freejoint name=\"f\"/>" + kInertial,
                   R"(<keyframe><key name="home" qpos="1 2 3 0 0 0 4" qvel="5 6 7 8 9 10"/></keyframe>)"))
          .joints[0];
  EXPECT_EQ(free.initial_origin[1].constant(), 2);
  EXPECT_EQ(free.initial_orientation[3].constant(), 1);
  EXPECT_EQ(free.initial_origin_velocity[2].constant(), 7);
  EXPECT_EQ(free.initial_spin[0].constant(), 8);
}

TEST(ReadMjcf, LeavesDampingOutOnRequest) {
  const std::string damped = one_body(R"(<joint name="j" type="ball" damping="2"/>)" + kInertial);
  EXPECT_EQ(read_cleanly(damped).joints[0].spin_damping.constant(), 2);
  EXPECT_TRUE(read_cleanly(damped, {.damping = false}).joints[0].spin_damping.is_zero());
  EXPECT_TRUE(read_cleanly(one_body(hinge("damping=\"2\"")), {.damping = false})
                  .joints[0]
                  .coordinates[0]
                  .damping.is_zero());
}

}  // namespace
}  // namespace jourdain::model
