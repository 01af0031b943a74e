#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "model/matrix3.hpp"
#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

constexpr double kRounding = 1e-15;

struct Read {
  Mechanism mechanism;
  std::string diagnostics;

  const Joint& joint(const std::string& name) const {
    const auto& joints = mechanism.joints;
    const auto found =
        std::find_if(joints.begin(), joints.end(), [&](const Joint& j) { return j.name == name; });
    EXPECT_NE(found, joints.end()) << name << '\n' << diagnostics;
    static const Joint none;
    return found == joints.end() ? none : *found;
  }
  const Frame& frame(const std::string& name) const {
    const auto& frames = mechanism.frames;
    const auto found =
        std::find_if(frames.begin(), frames.end(), [&](const Frame& f) { return f.name == name; });
    EXPECT_NE(found, frames.end()) << name << '\n' << diagnostics;
    static const Frame none;
    return found == frames.end() ? none : *found;
  }
};

Read read(const std::string& text, const ReadOptions& options = {}) {
  support::Diagnostics diagnostics("model.sdf", text);
  Mechanism mechanism = read_mechanism(diagnostics, options).value_or(Mechanism());
  return {std::move(mechanism), diagnostics.format()};
}

std::string model(const std::string& inside, const std::string& version = "1.9") {
  return fmt::format("<sdf version=\"{}\"><model name=\"m\">{}</model></sdf>", version, inside);
}

std::string link(const std::string& name, const std::string& inside = "") {
  return fmt::format(
      "<link name=\"{}\">{}<inertial><pose>0.1 0 0 0 0 "
      "0.3</pose><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.2"
      "</iyy><izz>0.25</izz><ixy>0.01</ixy><ixz>0</ixz><iyz>-0.02</iyz></inertia></inertial></link>",
      name, inside);
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& inside = "") {
  return fmt::format("<joint name=\"{}\" type=\"{}\"><parent>{}</parent><child>{}</child>{}</joint>", name,
                     type, parent, child, inside);
}

std::string pose(const std::string& numbers, const std::string& base = "") {
  return base.empty() ? fmt::format("<pose>{}</pose>", numbers)
                      : fmt::format("<pose relative_to=\"{}\">{}</pose>", base, numbers);
}

const std::string kArms = link("a", pose("1 2 3 0 0 0")) + link("b", pose("1 2 4 0 0 0.5"));
const std::string kShoulder = joint("shoulder", "revolute", "world", "a", "<axis><xyz>0 1 0</xyz></axis>");

void expect_near(const Vector3& found, const std::array<double, 3>& expected, double tolerance = kRounding) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k].constant(), expected[k], tolerance) << k;
}
void expect_near(const std::array<double, 3>& found, const std::array<double, 3>& expected) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], kRounding) << k;
}

TEST(ReadSdf, TakesLinksAndTheirInertials) {
  const Read of = read(model(kArms + kShoulder + joint("elbow", "revolute", "a", "b")));
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_EQ(of.mechanism.name, "m");
  ASSERT_EQ(of.mechanism.bodies.size(), 2u);
  const Body& a = of.mechanism.bodies[0];
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.mass.constant(), 2);
  expect_near(a.center_of_mass, {0.1, 0, 0});
  EXPECT_EQ(a.inertia.yy.constant(), 0.2);
  EXPECT_EQ(a.inertia.yz.constant(), -0.02);
  expect_near(a.inertia_axes.rpy, {0, 0, 0.3});
  EXPECT_EQ(of.mechanism.gravity[2].constant(), -9.81);
  EXPECT_EQ(of.mechanism.actuators.size(), 2u);
}

TEST(ReadSdf, PlacesJointsAtTheirChildren) {
  const Read of = read(model(kArms + kShoulder + joint("elbow", "revolute", "a", "b")));
  expect_near(of.joint("shoulder").placement.position, {1, 2, 3});
  EXPECT_EQ(of.joint("shoulder").axis, (std::array<double, 3>{0, 1, 0}));
  expect_near(of.joint("elbow").placement.position, {0, 0, 1});
  expect_near(of.joint("elbow").placement.rotation.rpy, {0, 0, 0.5});
  EXPECT_EQ(of.joint("elbow").axis, (std::array<double, 3>{0, 0, 1}));
  EXPECT_TRUE(of.mechanism.frames.empty());
}

/// The joint 0.2 above the link along its z: the body's frame goes there, and the link is 0.2 below.
TEST(ReadSdf, PutsBodiesAtTheJointsThatMoveThem) {
  const Read of =
      read(model(kArms + kShoulder + joint("elbow", "revolute", "a", "b", pose("0 0 0.2 0 0 0"))));
  expect_near(of.joint("elbow").placement.position, {0, 0, 1.2});
  expect_near(of.mechanism.bodies[1].center_of_mass, {0.1, 0, -0.2});
  expect_near(of.frame("b_link").placement.position, {0, 0, -0.2});
  EXPECT_EQ(of.frame("b_link").body, BodyIndex(1));
}

TEST(ReadSdf, PosesAreRelativeToAnyFrame) {
  const Read of = read(model("<frame name=\"f\" attached_to=\"a\">" + pose("0 1 0 0 0 0") + "</frame>" +
                             link("a", pose("1 2 3 0 0 0")) + link("b", pose("0 0 4 0 0 0", "f")) +
                             kShoulder + joint("elbow", "revolute", "f", "b", pose("0 0 -1 0 0 0", "f"))));
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_EQ(of.joint("elbow").parent, BodyIndex(0));
  expect_near(of.joint("elbow").placement.position, {0, 1, -1});
  expect_near(of.frame("b_link").placement.position, {0, 0, 5});
  expect_near(of.frame("f").placement.position, {0, 1, 0});
}

/// The pose of a model may be that of a frame in it, of a model inside too; then the model's own follows.
TEST(ReadSdf, ThePoseOfAModelIsThatOfItsPlacementFrame) {
  const auto root = [](const std::string& frame, const std::string& at) {
    return read("<sdf version=\"1.9\"><model name=\"m\" placement_frame=\"" + frame + "\">" + pose(at) +
                "<frame name=\"f\">" + pose("0 0 1 0 0 1.5707963267948966", "b") + "</frame>" + kArms +
                "<model name=\"tool\" placement_frame=\"tip\">" + pose("0 5 0 0 0 0", "a") +
                link("tip", pose("0 0 0.5 0 0 0")) + "</model>" + kShoulder +
                joint("elbow", "revolute", "a", "b") + joint("hold", "fixed", "b", "tool::tip") +
                "</model></sdf>");
  };
  // a stands at (1, 2, 3) of the model, which is turned so that f is as given.
  const Read of_link = root("a", "7 8 9 0 0 0");
  EXPECT_EQ(of_link.diagnostics, "");
  expect_near(of_link.joint("shoulder").placement.position, {7, 8, 9});
  const Read of_frame = root("f", "0 0 0 0 0 2.0707963267948966");
  EXPECT_EQ(of_frame.diagnostics, "");
  expect_near(of_frame.joint("shoulder").placement.position, {0, 0, -2});
  // The tip of the tool is where the tool's pose puts it: 5 beside a.
  expect_near(root("tool::tip", "0 0 0 0 0 0").joint("shoulder").placement.position, {0, -5, 0});
}

/// Frames that say nothing else are attached to the model's frame, and that to the link that the model names.
TEST(ReadSdf, TheFrameOfAModelIsAttachedToItsCanonicalLink) {
  const auto parent = [](const std::string& attribute, const std::string& inside = "") {
    const Read of = read("<sdf version=\"1.9\"><model name=\"m\"" + attribute + ">" + kArms + kShoulder +
                         joint("elbow", "revolute", "a", "b") + link("c") + "<frame name=\"f\"/>" + inside +
                         joint("wrist", "revolute", "f", "c") + "</model></sdf>");
    return of.diagnostics.empty() ? of.mechanism.bodies[of.joint("wrist").parent->value].name
                                  : of.diagnostics;
  };
  EXPECT_EQ(parent(""), "a");
  EXPECT_EQ(parent(" canonical_link=\"\""), "a");
  EXPECT_EQ(parent(" canonical_link=\"b\""), "b");
  const std::string inner =
      "<model name=\"n\">" + link("l") + "</model>" + joint("k", "revolute", "b", "n::l");
  EXPECT_EQ(parent(" canonical_link=\"n::l\"", inner), "n::l");
  EXPECT_NE(parent(" canonical_link=\"d\"").find("the model has no link 'd'"), std::string::npos);
  EXPECT_NE(parent(" canonical_link=\"n::m\"", inner).find("the model has no link 'n::m'"),
            std::string::npos);
}

TEST(ReadSdf, AnglesMayBeDegreesOrQuaternions) {
  const Read of = read(model(link("a", "<pose degrees=\"true\">0 0 0 0 0 30</pose>") +
                             link("b", "<pose rotation_format=\"quat_xyzw\">0 0 0 0 0 0.6 0.8</pose>") +
                             joint("j", "revolute", "world", "a") + joint("k", "revolute", "world", "b")));
  EXPECT_EQ(of.diagnostics, "");
  expect_near(of.joint("j").placement.rotation.rpy, {0, 0, std::numbers::pi / 6});
  expect_near(of.joint("k").placement.rotation.rpy, {0, 0, 2 * std::atan2(0.6, 0.8)});
}

/// A quarter turn about z takes the x of the link to the y of the model.
TEST(ReadSdf, AxesStandInTheFrameThatTheVersionSays) {
  const auto axis = [](const std::string& version, const std::string& inside) {
    const Read of = read(model(link("a", pose("0 0 0 0 0 1.5707963267948966")) +
                                   joint("j", "revolute", "world", "a", "<axis>" + inside + "</axis>"),
                               version));
    EXPECT_FALSE(of.mechanism.joints.empty()) << of.diagnostics;
    return of.joint("j").axis;
  };
  const std::string x = "<xyz>1 0 0</xyz>", flag = "<use_parent_model_frame>";
  const std::string on = flag + "1</use_parent_model_frame>", off = flag + "0</use_parent_model_frame>";
  expect_near(axis("1.6", x), {1, 0, 0});
  expect_near(axis("1.6", x + on), {0, -1, 0});
  expect_near(axis("1.4", x), {0, -1, 0});
  expect_near(axis("1.4", x + off), {1, 0, 0});
  expect_near(axis("1.7", x), {1, 0, 0});
  expect_near(axis("1.7", x + on), {1, 0, 0});
  expect_near(axis("1.7", "<xyz expressed_in=\"__model__\">1 0 0</xyz>"), {0, -1, 0});
}

TEST(ReadSdf, TakesDynamics) {
  const std::string text = model(kArms +
                                 joint("j", "prismatic", "world", "a",
                                       "<axis><xyz>1 0 0</xyz><limit><lower>-1</lower><upper>2</upper>"
                                       "</limit><dynamics><damping>3</damping><friction>4</friction>"
                                       "<spring_stiffness>5</spring_stiffness><spring_reference>0.6"
                                       "</spring_reference></dynamics></axis>") +
                                 joint("k", "fixed", "a", "b"));
  const Read of = read(text);
  const Coordinate& c = of.joint("j").coordinates.at(0);
  EXPECT_EQ(c.damping.constant(), 3);
  EXPECT_EQ(c.stiffness.constant(), 5);
  EXPECT_EQ(c.rest.constant(), 0.6);
  EXPECT_TRUE(c.friction.is_zero());
  EXPECT_FALSE(c.range);  // nothing is proven without loops
  EXPECT_NE(of.diagnostics.find("warning: friction of joint 'j' is ignored"), std::string::npos);
  const Read rubbing = read(text, {.damping = false, .friction = true});
  EXPECT_EQ(rubbing.joint("j").coordinates.at(0).friction.constant(), 4);
  EXPECT_TRUE(rubbing.joint("j").coordinates.at(0).damping.is_zero());
  EXPECT_EQ(rubbing.diagnostics, "");
}

TEST(ReadSdf, TakesJointsOfEveryType) {
  const Read of =
      read(model(link("a") + link("b") + link("c") + link("d") + link("e") +
                 joint("hinge", "continuous", "world", "a") + joint("ball", "ball", "world", "b") +
                 joint("cross", "universal", "world", "c",
                       "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>") +
                 joint("screw", "screw", "world", "d", "<screw_thread_pitch>0.002</screw_thread_pitch>") +
                 joint("old", "screw", "world", "e", "<thread_pitch>-50</thread_pitch>")));
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_EQ(of.joint("hinge").type, JointType::kRevolute);
  EXPECT_EQ(of.joint("ball").type, JointType::kSpherical);
  EXPECT_EQ(of.joint("cross").type, JointType::kUniversal);
  EXPECT_EQ(of.joint("cross").axis, (std::array<double, 3>{1, 0, 0}));
  EXPECT_EQ(of.joint("cross").second_axis, (std::array<double, 3>{0, 1, 0}));
  EXPECT_NEAR(of.joint("screw").pitch.constant(), 0.002 / (2 * std::numbers::pi), 1e-18);
  EXPECT_NEAR(of.joint("old").pitch.constant(), 0.02, 1e-17);  // right-handed, 50 rad a metre
}

TEST(ReadSdf, WhatNoJointCarriesIsFreeUnlessFixedOrStatic) {
  const std::string arms = kArms + joint("elbow", "revolute", "a", "b");
  const Read free = read(model(arms));
  EXPECT_EQ(free.joint("root").type, JointType::kFree);
  expect_near(free.joint("root").initial_origin, {1, 2, 3});
  const Read fixed = read(model(arms), {.root = RootJoint::kFixed});
  EXPECT_EQ(fixed.joint("a_to_world").type, JointType::kFixed);
  expect_near(fixed.joint("a_to_world").placement.position, {1, 2, 3});
  const Read turned = read(model(pose("0 0 1 0 0 0.4") + link("a", pose("1 0 0 0 0 0"))));
  expect_near(turned.joint("root").initial_origin, {std::cos(0.4), std::sin(0.4), 1});
  EXPECT_NEAR(turned.joint("root").initial_orientation[3].constant(), std::sin(0.2), kRounding);
}

/// A world: its gravity, names with those of their models, a static model, a joint between models.
TEST(ReadSdf, TakesWorlds) {
  const Read of = read(
      "<sdf version=\"1.10\"><world name=\"w\"><gravity>0 0 -1.6</gravity>"
      "<model name=\"table\"><static>true</static>" +
      link("top", pose("0 0 1 0 0 0")) + "</model><model name=\"arm\">" + pose("0 0 2 0 0 0") + link("a") +
      link("b") + joint("j", "revolute", "a", "b") + "</model>" +
      joint("mount", "fixed", "table::top", "arm::a") + "</world></sdf>");
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_EQ(of.mechanism.gravity[2].constant(), -1.6);
  EXPECT_EQ(of.joint("table::top_to_world").type, JointType::kFixed);
  EXPECT_EQ(of.joint("arm::j").parent, BodyIndex(1));
  EXPECT_EQ(of.joint("mount").parent, BodyIndex(0));
  expect_near(of.joint("mount").placement.position, {0, 0, 1});
  EXPECT_EQ(moving_joints(of.mechanism).size(), 1u);
}

/// Its place moved from <physics> into the <world> with 1.6.
TEST(ReadSdf, TakesGravityFromWhereTheVersionHasIt) {
  const auto world = [](const std::string& version, const std::string& inside) {
    return read(
        fmt::format("<sdf version=\"{}\"><world name=\"w\">{}<model name=\"m\">{}</model></world></sdf>",
                    version, inside, link("a") + kShoulder));
  };
  const std::string moon = "<gravity>0 0 -1.62</gravity>", physics = "<physics>" + moon + "</physics>";
  for (const char* version : {"1.4", "1.5"}) {
    const Read of = world(version, physics);
    EXPECT_EQ(of.mechanism.gravity[2].constant(), -1.62) << version;
    EXPECT_EQ(of.diagnostics, "") << version;
  }
  const std::string chosen = "<physics default=\"true\"><gravity>0 0 -3.7</gravity></physics>";
  const Read two = world("1.5", physics + chosen);
  EXPECT_EQ(two.mechanism.gravity[2].constant(), -3.7);
  EXPECT_NE(two.diagnostics.find("warning: this <gravity> of <physics> is ignored"), std::string::npos);
  const Read later = world("1.7", physics);
  EXPECT_EQ(later.mechanism.gravity[2].constant(), -9.8);
  EXPECT_NE(later.diagnostics.find("warning: this <gravity> of <physics> is ignored"), std::string::npos);
  EXPECT_EQ(world("1.7", "<physics/>" + moon).mechanism.gravity[2].constant(), -1.62);
}

TEST(ReadSdf, NestedModelsKeepTheirNames) {
  const Read of =
      read(model(link("base") + "<model name=\"hand\">" + pose("0 0 1 0 0 0") +
                 link("palm", pose("0 1 0 0 0 0")) + "</model>" + joint("mount", "fixed", "world", "base") +
                 joint("wrist", "revolute", "base", "hand::palm")));
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_EQ(of.mechanism.bodies[1].name, "hand::palm");
  expect_near(of.joint("wrist").placement.position, {0, 1, 1});
}

/// The second joint that would carry b becomes a loop; ranges are those of the joints that stay.
TEST(ReadSdf, JointsThatWouldCarryALinkTwiceBecomeLoops) {
  const std::string limit = "<axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>";
  const Read of = read(
      model(link("a") + link("b", pose("1 0 0 0 0 0")) + link("c", pose("1 0 1 0 0 0")) +
            joint("j", "revolute", "world", "a", limit) +
            joint("k", "revolute", "a", "b", "<axis><xyz>0 1 0</xyz></axis>") +
            joint("l", "revolute", "world", "c", "<axis><xyz>0 1 0</xyz></axis>") +
            joint("close", "revolute", "c", "b", pose("0 0 0.5 0 0 0") + "<axis><xyz>0 1 0</xyz></axis>")));
  EXPECT_NE(of.diagnostics.find("note: joint 'close' closes a loop: it has no coordinate and no input"),
            std::string::npos);
  ASSERT_EQ(of.mechanism.loops.size(), 1u);
  const Loop& loop = of.mechanism.loops[0];
  EXPECT_EQ(loop.name, "close");
  EXPECT_EQ(loop.type, LoopType::kRevolute);
  EXPECT_EQ(loop.axis, (std::array<double, 3>{0, 1, 0}));
  const Frame &from = of.mechanism.frames[loop.from.value], &to = of.mechanism.frames[loop.to.value];
  EXPECT_EQ(from.body, BodyIndex(2));
  EXPECT_EQ(to.body, BodyIndex(1));
  expect_near(from.placement.position, {0, 0, -0.5});
  expect_near(to.placement.position, {0, 0, 0.5});
  EXPECT_EQ(of.joint("j").coordinates.at(0).range, (std::array<double, 2>{-1, 1}));
  EXPECT_FALSE(of.joint("l").coordinates.at(0).range);
}

TEST(ReadSdf, JointsWithSpringsStayInTheTree) {
  const std::string spring =
      "<axis><xyz>0 1 0</xyz><dynamics><spring_stiffness>9</spring_stiffness></dynamics></axis>";
  const Read of =
      read(model(link("a") + link("b") + joint("j", "revolute", "world", "a") +
                 joint("k", "revolute", "world", "b") + joint("sprung", "revolute", "a", "b", spring)));
  ASSERT_EQ(of.mechanism.loops.size(), 1u);
  EXPECT_EQ(of.mechanism.loops[0].name, "k");
  EXPECT_EQ(of.joint("sprung").coordinates.at(0).stiffness.constant(), 9);
}

double residual(const Read& of, std::size_t loop, const std::array<double, 3>& y) {
  return of.mechanism.loops.at(loop).residual.evaluate<double>(
      {}, [](double v) { return v; }, [&](const Variable& v) { return y.at(v.index); });
}

/// θ₂ = −2 θ₁ about axes that point the same way as those of the joints, and the other way for the child.
TEST(ReadSdf, GearboxesAreCouplers) {
  const std::string y = "<axis><xyz>0 1 0</xyz></axis>",
                    gear =
                        "<gearbox_ratio>2</gearbox_ratio>"
                        "<gearbox_reference_body>f</gearbox_reference_body>";
  const std::string parts = link("f") + link("p") + link("c") + joint("base", "fixed", "world", "f") +
                            joint("in", "revolute", "f", "p", y) + joint("out", "revolute", "f", "c", y);
  const Read same =
      read(model(parts + joint("gears", "gearbox", "p", "c", y + "<axis2><xyz>0 1 0</xyz></axis2>" + gear)));
  EXPECT_EQ(same.diagnostics, "");
  ASSERT_EQ(same.mechanism.loops.size(), 1u);
  EXPECT_NEAR(residual(same, 0, {0, 3, 7}), 7 + 2 * 3, kRounding);
  const Read other =
      read(model(parts + joint("gears", "gearbox", "p", "c", y + "<axis2><xyz>0 -1 0</xyz></axis2>" + gear)));
  EXPECT_NEAR(residual(other, 0, {0, 3, 7}), 7 - 2 * 3, kRounding);
}

TEST(ReadSdf, MimicsAreCouplers) {
  const std::string mimic =
      "<axis><xyz>0 0 1</xyz><mimic joint=\"j\"><multiplier>3</multiplier><offset>0.5</offset><reference>0.1"
      "</reference></mimic></axis>";
  const std::string text = model(link("a") + link("b") + joint("j", "revolute", "world", "a") +
                                     joint("k", "revolute", "world", "b", mimic),
                                 "1.11");
  const Read of = read(text);
  EXPECT_EQ(of.diagnostics, "");
  ASSERT_EQ(of.mechanism.loops.size(), 1u);
  EXPECT_NEAR(residual(of, 0, {2, 11, 0}), 11 - (3 * (2 - 0.1) + 0.5), 1e-14);
  EXPECT_NEAR(of.joint("k").coordinates.at(0).initial_position.constant(), 0.2, kRounding);
  EXPECT_EQ(of.mechanism.actuators.size(), 1u);
  EXPECT_TRUE(read(text, {.mimic = false}).mechanism.loops.empty());
}

TEST(ReadSdf, RightAnglesOfPosesAreExact) {
  const std::string text =
      model(link("a", pose("0 0 0 0 1.5708 0")) + joint("j", "revolute", "world", "a") +
            link("b", pose("0 1 0 0 1.5708 -1.5708")) + joint("k", "revolute", "a", "b"));
  const Read of = read(text);
  EXPECT_NE(of.diagnostics.find("note: 3 angles of poses within 2e-05 rad of a right angle read as exact"),
            std::string::npos)
      << of.diagnostics;
  const Vector3& rpy = of.joint("k").placement.rotation.rpy;
  const Matrix3 R = rotation_from_rpy({rpy[0].constant(), rpy[1].constant(), rpy[2].constant()});
  // Ry(-90°) Rz(-90°) Ry(90°) turns x to x, y to z and z to -y.
  const Matrix3 expected{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}};
  for (std::size_t i = 0; i < 3; ++i) expect_near(R[i], expected[i]);
  EXPECT_EQ(read(text, {.snap = 0}).diagnostics, "");
}

TEST(ReadSdf, AttributesAreReadOrTold) {
  const auto said = [](const std::string& inside, const std::string& part) {
    const std::string diagnostics = read(model(link("a", inside) + kShoulder)).diagnostics;
    EXPECT_NE(diagnostics.find(part), std::string::npos) << diagnostics;
  };
  said("<pose relativ_to=\"a\">0 0 0 0 0 0</pose>", "warning: attribute 'relativ_to' of <pose> is ignored");
  said("<pose degrees=\"yes\">0 0 0 90 0 0</pose>", "error: 'degrees' is true or false, not 'yes'");
  said("<pose rotation_format=\"quat_wxyz\">0 0 0 0 0 0</pose>",
       "error: 'rotation_format' is euler_rpy or quat_xyzw, not 'quat_wxyz'");
  said("<inertial><pose relative_to=\"b\">0 0 0 0 0 0</pose></inertial>",
       "warning: the frame of the <pose> of an <inertial> is ignored");
  const std::string ball = "<axis><dynamics><damping>2</damping></dynamics></axis>";
  const std::string of_ball = read(model(link("a") + joint("j", "ball", "world", "a", ball))).diagnostics;
  EXPECT_NE(of_ball.find("warning: the <damping> of ball joint 'j' is ignored"), std::string::npos)
      << of_ball;
  const std::string axis = "<axis><xyz expresed_in=\"__model__\">0 1 0</xyz></axis>";
  const std::string diagnostics =
      read(model(link("a") + joint("j", "revolute", "world", "a", axis))).diagnostics;
  EXPECT_NE(diagnostics.find("attribute 'expresed_in' of <xyz> is ignored"), std::string::npos)
      << diagnostics;
}

TEST(ReadSdf, CommentsDoNotEndTexts) {
  const Read of = read(
      model(link("a") + joint("j", "revolute", "world", "a",
                              "<axis><xyz>0 <!-- not 1 --> 0 1</xyz><dynamics><damping><!-- c -->1<!-- c -->5"
                              "</damping></dynamics></axis>")));
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_EQ(of.joint("j").coordinates[0].damping.constant(), 15);
  EXPECT_EQ(of.joint("j").axis[2], 1);
}

}  // namespace
}  // namespace jourdain::model
