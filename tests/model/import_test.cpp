// Descriptions that import others give the mechanism that one file would describe.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <span>

#include "compile/compile.hpp"
#include "model/read/read.hpp"
#include "model/snap.hpp"
#include "properties/to_toml.hpp"
#include "reference/minimal.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::model {
namespace {

const std::string kData = std::string(JOURDAIN_SOURCE_DIR) + "/tests/data/";

/// Files in a folder of their own, which is gone afterwards.
class Files {
 public:
  Files& add(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(path(name).parent_path());
    support::write_file(path(name).string(), text);
    return *this;
  }

  struct Result {
    std::optional<Mechanism> mechanism;
    std::string messages;
  };
  Result read(const std::string& name, const ReadOptions& options = {}) const {
    support::Diagnostics diagnostics(path(name).string(), support::read_file(path(name).string()));
    std::optional<Mechanism> mechanism = read_mechanism(diagnostics, options);
    std::string messages = diagnostics.format();
    for (std::size_t at; (at = messages.find(folder_.path() + "/")) != std::string::npos;)
      messages.erase(at, folder_.path().size() + 1);
    return {std::move(mechanism), messages};
  }

  /// A description that must be without any message.
  Mechanism cleanly(const std::string& name, const ReadOptions& options = {}) const {
    Result result = read(name, options);
    EXPECT_EQ(result.messages, "");
    return result.mechanism.value_or(Mechanism());
  }

  std::filesystem::path path(const std::string& name) const {
    return std::filesystem::path(folder_.path()) / name;
  }

 private:
  support::TemporaryFolder folder_;
};

Mechanism by_hand(const std::string& text, const std::string& name = "model.toml") {
  return Files().add(name, text).cleanly(name);
}

double value(const Mechanism& mechanism, const Expression& expression, std::vector<double> parameters = {}) {
  if (parameters.empty()) parameters = default_values(mechanism);
  return expression.evaluate<double>(std::span<const double>(parameters));
}

const std::string kHead = "[model]\nname = \"m\"\n\n";

std::string link(const std::string& name, const std::string& joint, const std::string& parent,
                 const std::string& more = "") {
  return "[[body]]\nname = \"" + name +
         "\"\nmass = 1\ncenter_of_mass = [0, 0, -0.5]\n\n[[joint]]\nname = \"" + joint +
         "\"\ntype = \"revolute\"\nparent = \"" + parent + "\"\nchild = \"" + name +
         "\"\naxis = [0, 1, 0]\n" + more + "\n";
}

/// An arm with everything that a file can declare.
const std::string kArm = R"([model]
name = "arm"
gravity = [0, 0, -1]

[parameters]
l = { value = 0.5, unit = "m", range = [0.1, 1] }
half = "l/2"
m = 2

[[body]]
name = "upper"
mass = "m"
center_of_mass = ["half", 0, 0]

[[body]]
name = "lower"
shape = { kind = "box", size = ["l", 0.1, 0.1], density = 100 }

[[joint]]
name = "shoulder"
type = "revolute"
parent = "world"
child = "upper"
position = [0, 0, 0.3]
axis = [0, 1, 0]
initial_position = 0.2

[[joint]]
name = "elbow"
type = "universal"
parent = "upper"
child = "lower"
position = ["l", 0, 0]
first = { damping = 0.1 }

[[frame]]
name = "tip"
body = "lower"
position = ["l", 0, 0]

[[frame]]
name = "hook"
body = "world"
position = [1, 0, 0]

[[actuator]]
joint = "shoulder"
name = "motor"

[[input]]
name = "wind"
unit = "N"

[[force]]
name = "gust"
frame = "tip"
force = ["wind", "motor*0.1", "-0.2*tip.vx"]

[[force]]
name = "drag"
joint = "shoulder"
value = "-0.1*elbow_first.rate"

[[spring]]
name = "cord"
from = "hook"
to = "upper"
stiffness = 10
law = "0.1*rate"

[[bushing]]
name = "rubber"
from = "hook"
to = "tip"
stiffness = [1, 2, 3]

[[output]]
name = "reach"
kind = "expression"
value = "tip.x + half + upper.y"
)";

/// With `prefix` before each name that kArm declares, within quotes or in expressions.
std::string prefixed_arm(const std::string& prefix) {
  std::string text = kArm.substr(kArm.find("[[body]]"));
  for (const std::string name : {"upper", "lower", "shoulder", "elbow", "tip", "hook", "motor", "wind",
                                 "cord", "gust", "drag", "rubber", "reach", "half"})
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos;
         at += prefix.size() + name.size())
      text.insert(at, prefix);
  for (const std::string& name : {std::string("\"l\""), std::string("\"m\"")})
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; at += prefix.size() + 3)
      text.insert(at + 1, prefix);
  return text;
}

TEST(Import, OfAFileIsThatFile) {
  Files files;
  files.add("arm.toml", kArm)
      .add("model.toml", "[model]\nname = \"arm\"\ngravity = [0, 0, -1]\n[import]\nfile = \"arm.toml\"\n");
  EXPECT_EQ(tests::to_toml(files.cleanly("model.toml")), tests::to_toml(files.cleanly("arm.toml")));
}

TEST(Import, OfTwoArmsOnOneBaseIsWhatOneFileWouldSay) {
  Files files;
  files.add("parts/arm.toml", kArm);
  const std::string base =
      "[[body]]\nname = \"base\"\nmass = 9\n\n[[joint]]\nname = \"lift\"\ntype = \"prismatic\"\nparent = "
      "\"world\"\nchild = \"base\"\n\n[[actuator]]\njoint = \"lift\"\n\n";
  files.add("model.toml", kHead +
                              "[parameters]\nlength = { value = 0.7, unit = \"m\", range = [0.6, 0.8] }\n\n"
                              "[[import]]\nfile = \"parts/arm.toml\"\nprefix = \"a_\"\nparent = \"base\"\n"
                              "position = [0, 0.1, 0]\nparameters = { l = \"length\" }\n\n"
                              "[[import]]\nfile = \"parts/arm.toml\"\nprefix = \"b_\"\nparent = \"base\"\n"
                              "position = [0, \"-length\", 0]\n\n" +
                              base);
  Mechanism expected =
      by_hand(kHead +
              "[parameters]\na_l = { value = 0.7, unit = \"m\", range = [0.6, 0.8] }\na_m = 2\n"
              "b_l = { value = 0.5, unit = \"m\", range = [0.1, 1] }\nb_m = 2\na_half = \"a_l/2\"\nb_half = "
              "\"b_l/2\"\n" +
              prefixed_arm("a_") + prefixed_arm("b_") + base);
  // By hand the joints and frames of the world are placed on the base.
  for (Joint& joint : expected.joints)
    if (joint.name == "a_shoulder" || joint.name == "b_shoulder") joint.parent = BodyIndex(4);
  for (Frame& frame : expected.frames)
    if (frame.name == "a_hook" || frame.name == "b_hook") frame.body = BodyIndex(4);
  const Expression length = Expression::parameter(ParameterIndex(0));
  const Expression a = 0.1, b = Expression::unary(Expression::Op::kNegate, length);
  for (auto* list : {&expected.joints}) {
    (*list)[0].placement.position[1] = a;
    (*list)[2].placement.position[1] = b;
  }
  for (Frame& frame : expected.frames) {
    if (frame.name == "a_hook") frame.placement.position[1] = a;
    if (frame.name == "b_hook") frame.placement.position[1] = b;
  }
  expected.parameters[0].name = "length";
  EXPECT_EQ(tests::to_toml(files.cleanly("model.toml")), tests::to_toml(expected));
}

TEST(Import, TakesGravityAndNameFromTheImportingFile) {
  Files files;
  files.add("arm.toml", kArm).add("model.toml", kHead + "[[import]]\nfile = \"arm.toml\"\n");
  const Mechanism mechanism = files.cleanly("model.toml");
  EXPECT_EQ(mechanism.name, "m");
  EXPECT_EQ(mechanism.gravity[2].constant(), -9.81);
}

const std::string kPayload =
    "[[body]]\nname = \"payload\"\nmass = MASS\ncenter_of_mass = [0, 0, 0.02]\n"
    "inertia = [0.01, 0.02, 0.025]\n\n[[joint]]\nname = \"grip\"\ntype = \"fixed\"\n"
    "parent = \"tool\"\nchild = \"payload\"\nposition = [0, 0, 0.12]\n";

std::string with_mass(const std::string& mass) {
  std::string text = kPayload;
  return text.replace(text.find("MASS"), 4, mass);
}

/// The robot with a payload as one URDF file.
std::string robot_with_payload() {
  std::string text = support::read_file(kData + "robots/rail_arm.urdf");
  const std::string payload = R"(<link name="payload"><inertial><origin xyz="0 0 0.02"/><mass value="2.5"/>
    <inertia ixx="0.01" iyy="0.02" izz="0.025" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="grip" type="fixed"><parent link="tool"/><child link="payload"/><origin xyz="0 0 0.12"/></joint>)";
  return text.insert(text.rfind("</robot>"), payload);
}

std::string kernels(const Mechanism& mechanism) {
  CompileOptions options;
  options.functions = {"forward_dynamics", "mass_matrix"};
  const CompiledModel compiled = compile(mechanism, options);
  for (const emit::File& file : compiled.files)
    if (file.name.ends_with("_kernels.hpp")) return file.text;
  return "";
}

TEST(Import, OfARobotWithAPayloadCompilesToTheKernelsOfTheMergedRobot) {
  Files files;
  files.add("robot.urdf", support::read_file(kData + "robots/rail_arm.urdf"))
      .add("model.toml", "[model]\nname = \"rail_arm\"\n[import]\nfile = \"robot.urdf\"\n" + with_mass("2.5"))
      .add("merged.urdf", robot_with_payload());
  const Mechanism imported = *files.read("model.toml").mechanism,
                  merged = *files.read("merged.urdf").mechanism;
  const std::string text = kernels(imported);
  EXPECT_GT(text.size(), 1000u);
  EXPECT_EQ(text, kernels(merged));
}

TEST(Import, LeavesTheMassOfAPayloadTunable) {
  Files files;
  files.add("robot.urdf", support::read_file(kData + "robots/rail_arm.urdf"))
      .add("model.toml", kHead +
                             "[parameters]\nload = { value = 2.5, unit = \"kg\" }\n[import]\nfile = "
                             "\"robot.urdf\"\n" +
                             with_mass("\"load\""));
  const Mechanism mechanism = *files.read("model.toml").mechanism;
  ASSERT_EQ(mechanism.parameters.size(), 1u);
  const Body& payload = mechanism.bodies.back();
  EXPECT_EQ(payload.name, "payload");
  EXPECT_EQ(value(mechanism, payload.mass), 2.5);
  EXPECT_EQ(value(mechanism, payload.mass, {4.0}), 4.0);
}

TEST(Import, ThroughTwoFilesPrefixesTwice) {
  Files files;
  files.add("robot.urdf", support::read_file(kData + "robots/rail_arm.urdf"))
      .add("lib/tool.toml", "[[import]]\nfile = \"../robot.urdf\"\nprefix = \"r_\"\nlock = [\"pan\"]\n" +
                                link("probe", "swing", "r_tool"))
      .add("model.toml", kHead + "[[import]]\nfile = \"lib/tool.toml\"\nprefix = \"left_\"\n");
  const Files::Result result = files.read("model.toml");
  ASSERT_TRUE(result.mechanism) << result.messages;
  const Mechanism& mechanism = *result.mechanism;
  EXPECT_EQ(mechanism.bodies.front().name, "left_r_rail");
  EXPECT_EQ(mechanism.bodies.back().name, "left_probe");
  EXPECT_EQ(mechanism.joints[1].name, "left_r_pan");
  EXPECT_EQ(mechanism.joints[1].type, JointType::kFixed);
  ASSERT_EQ(mechanism.imports.size(), 2u);
  EXPECT_EQ(mechanism.imports[1].prefix, "left_r_");
  EXPECT_EQ(mechanism.imports[1].file, 2);
}

TEST(Import, LocksByTheNameInTheWhole) {
  Files files;
  files.add("arm.toml", kArm).add("model.toml", kHead + "[[import]]\nfile = \"arm.toml\"\nprefix = \"a_\"\n");
  const Mechanism mechanism = files.cleanly("model.toml", {.locked_joints = {"a_shoulder"}});
  EXPECT_EQ(mechanism.joints[0].type, JointType::kFixed);
}

const std::string kFollower = link("a", "lead", "world") + link("b", "fol", "world") +
                              "[[coupler]]\ncoordinate = \"fol\"\nfollows = \"lead\"\nratio = 2\n";

TEST(Import, LocksFollowersAndWhatTheyFollow) {
  const auto locked = [](const std::string& list) {
    return Files()
        .add("part.toml", kHead + kFollower)
        .add("model.toml", kHead + "[[import]]\nfile = \"part.toml\"\nlock = [" + list + "]\n\n" +
                               link("c", "other", "world"))
        .read("model.toml");
  };
  const Files::Result follower = locked("\"fol\"");
  EXPECT_NE(follower.messages.find("note: joint 'fol' is locked and does not follow 'lead'"),
            std::string::npos);
  ASSERT_TRUE(follower.mechanism);
  EXPECT_TRUE(follower.mechanism->loops.empty());
  EXPECT_EQ(follower.mechanism->joints[0].type, JointType::kRevolute);
  EXPECT_EQ(follower.mechanism->joints[1].type, JointType::kFixed);
  const Files::Result leader = locked("\"lead\"");
  EXPECT_NE(leader.messages.find("note: joint 'fol' is locked with 'lead', which it follows"),
            std::string::npos);
  ASSERT_TRUE(leader.mechanism);
  EXPECT_TRUE(leader.mechanism->loops.empty());
  for (const int j : {0, 1}) EXPECT_EQ(leader.mechanism->joints[std::size_t(j)].type, JointType::kFixed) << j;
  EXPECT_FALSE(locked("\"non\"").mechanism);
}

/// What expressions name stays an input when the joint that it drove is locked.
TEST(Import, LockedJointsLeaveTheirInputsToExpressions) {
  const std::string scene =
      kHead + link("a", "ja", "world") + link("b", "jb", "world") +
      "[[actuator]]\njoint = \"ja\"\nname = \"m\"\n\n[[actuator]]\njoint = \"jb\"\nname = "
      "\"n\"\n\n[[input]]\nname = \"wind\"\n\n[[force]]\njoint = \"jb\"\nvalue = \"wind - "
      "m*2 + n*4\"\n\n[[force]]\njoint = \"ja\"\nvalue = \"m\"\n";
  const Mechanism m = Files().add("model.toml", scene).cleanly("model.toml", {.locked_joints = {"ja"}});
  ASSERT_EQ(m.actuators.size(), 1u);
  EXPECT_EQ(m.actuators[0].name, "n");
  ASSERT_EQ(m.inputs.size(), 2u);
  EXPECT_EQ(m.inputs[0].name, "m");
  const reference::Reference<double> numbers(m);
  const auto q_bar =
      numbers
          .evaluate(
              {.t = 0, .y = reference::VectorX<double>::Zero(1), .z = reference::VectorX<double>::Zero(1)},
              Eigen::Vector3d(1, 10, 100))
          .q_bar;
  EXPECT_EQ(q_bar[0], -(1 + 100 - 2 * 10 + 4 * 1));
  const Mechanism unnamed =
      Files()
          .add("model.toml",
               kHead + link("a", "ja", "world") + link("b", "jb", "world") +
                   "[[actuator]]\njoint = \"ja\"\nname = \"m\"\n\n[[force]]\njoint = \"ja\"\nvalue = \"m\"\n")
          .cleanly("model.toml", {.locked_joints = {"ja"}});
  EXPECT_TRUE(unnamed.inputs.empty());
}

/// A cable pulls both ends, also the one on the world of its file, which is on a body here. No force is left over.
TEST(Import, PutsCablesOnWhatTheirWorldHangsOn) {
  const auto slide = [](const std::string& body, const std::string& joint) {
    return "[[body]]\nname = \"" + body + "\"\nmass = 1\n\n[[joint]]\nname = \"" + joint +
           "\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = \"" + body + "\"\naxis = [1, 0, 0]\n\n";
  };
  const std::string part = kHead + slide("b", "j") +
                           "[[cable]]\nthrough = [\"world\", \"b\"]\nstiffness = 100\nfree_length = 0.5\n";
  const Mechanism m = Files()
                          .add("part.toml", part)
                          .add("model.toml", kHead + slide("base", "rail") +
                                                 "[[import]]\nfile = \"part.toml\"\nparent = \"base\"\n")
                          .cleanly("model.toml");
  EXPECT_EQ(m.loads.size(), 2u);
  const reference::Reference<double> numbers(m);
  const auto q_bar =
      numbers.evaluate({.t = 0, .y = Eigen::Vector2d(0.3, 1), .z = Eigen::Vector2d(0, 0)}, {}).q_bar;
  EXPECT_NEAR(q_bar[0], 0, 1e-12);
  EXPECT_NEAR(q_bar[1], 50, 1e-12);
  EXPECT_EQ(by_hand(part).loads.size(), 1u);
}

TEST(Import, TakesAnglesAsTheWholeIsToldTo) {
  Files files;
  files
      .add("part.sdf",
           "<sdf version=\"1.9\"><model name=\"m\"><link name=\"a\"><pose>0 0 0 1.57081 0 0</pose><inertial>"
           "<mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link>"
           "<joint name=\"j\" type=\"revolute\"><parent>world</parent><child>a</child><axis><xyz>1 0 0</xyz>"
           "</axis></joint></model></sdf>")
      .add("model.toml", kHead + "[[import]]\nfile = \"part.sdf\"\n");
  const auto roll = [&](double snap) {
    const Files::Result result = files.read("model.toml", {.snap = snap});
    return result.mechanism ? value(*result.mechanism, result.mechanism->joints[0].placement.rotation.rpy[0])
                            : 0;
  };
  EXPECT_NEAR(roll(0), 1.57081, 1e-15);
  EXPECT_EQ(roll(kDefaultSnap), std::numbers::pi / 2);
}

/// Rz(90°): x to y. The start (1, 2, 3) becomes (-2, 1, 3) and is moved by (0, 0, 10); half of the angle is 45°.
TEST(Import, PlacesWhereAFreeJointStarts) {
  Files files;
  files
      .add("drone.toml",
           "[[body]]\nname = \"drone\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = \"flight\"\ntype = "
           "\"free\"\nparent = \"world\"\nchild = \"drone\"\ninitial_position = [1, 2, 3]\ninitial_velocity "
           "= [4, 0, 0]\ninitial_angular_velocity = [0, 0, 5]\n")
      .add("model.toml",
           kHead + "[import]\nfile = \"drone.toml\"\nposition = [0, 0, 10]\nrpy = [0, 0, \"90 deg\"]\n");
  const Mechanism mechanism = files.cleanly("model.toml");
  const Joint& flight = mechanism.joints[0];
  EXPECT_FALSE(flight.parent);
  const double origin[] = {-2, 1, 13}, velocity[] = {0, 4, 0}, spin[] = {0, 0, 5};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(flight.initial_origin[k].constant(), origin[k], 1e-14);
    EXPECT_NEAR(flight.initial_origin_velocity[k].constant(), velocity[k], 1e-14);
    EXPECT_EQ(flight.initial_spin[k].constant(), spin[k]);
  }
  const double orientation[] = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(flight.initial_orientation[k].constant(), orientation[k], 1e-15);
}

/// Angles of two placements are not added up: the file hangs on a body of its own.
TEST(Import, ThatIsTurnedHangsOnAMount) {
  Files files;
  files.add("arm.toml", kArm)
      .add("model.toml", kHead + "[[import]]\nfile = \"arm.toml\"\nprefix = \"a_\"\nrpy = [0.1, 0.2, 0.3]\n");
  const Mechanism mechanism = files.cleanly("model.toml");
  ASSERT_EQ(mechanism.bodies.size(), 3u);
  EXPECT_EQ(mechanism.bodies[2].name, "a_mount");
  const Joint& mount = mechanism.joints[2];
  EXPECT_EQ(mount.type, JointType::kFixed);
  EXPECT_FALSE(mount.parent);
  EXPECT_EQ(mount.placement.rotation.rpy[2].constant(), 0.3);
  EXPECT_EQ(mechanism.joints[0].parent, BodyIndex(2));
  EXPECT_EQ(mechanism.joints[0].placement.position[2].constant(), 0.3);
}

/// The axis of a pin is in the axes of the body that carries both ends, which is the imported world.
TEST(Import, ThatIsTurnedKeepsTheAxesOfItsPins) {
  Files files;
  files.add("linkage.toml", support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/four_bar.toml"))
      .add("model.toml",
           kHead + "[[import]]\nfile = \"linkage.toml\"\nprefix = \"a_\"\nrpy = [\"90 deg\", 0, 0]\n");
  const Mechanism mechanism = files.cleanly("model.toml");
  const Loop& pin = mechanism.loops[0];
  ASSERT_EQ(pin.type, LoopType::kPlanarPin);
  const auto body =
      carrier(mechanism, mechanism.frames[pin.from.value].body, mechanism.frames[pin.to.value].body);
  ASSERT_TRUE(body);
  EXPECT_EQ(mechanism.bodies[body->value].name, "a_mount");
}

/// Radii are of parameters, whose numbers are others in the whole.
TEST(Import, KeepsTheParametersOfWhatRolls) {
  Files files;
  files
      .add("stone.toml",
           "[model]\nname = \"stone\"\n[parameters]\na = 0.2\n" + link("stone", "spin", "world") +
               "[[constraint]]\nname = \"rolls\"\ntype = \"rolling_ellipsoid\"\nframe = \"stone\"\n"
               "radii = [\"a\", \"2*a\", 0.5]\n")
      .add("model.toml",
           kHead + "[parameters]\nb = 7\nc = 8\n[[import]]\nfile = \"stone.toml\"\nprefix = \"s_\"\n");
  const Mechanism mechanism = files.cleanly("model.toml");
  ASSERT_EQ(mechanism.loops.size(), 1u);
  const std::vector<double> values = default_values(mechanism);
  EXPECT_EQ(mechanism.loops[0].radii[0].evaluate<double>(values), 0.2);
  EXPECT_EQ(mechanism.loops[0].radii[1].evaluate<double>(values), 0.4);
  EXPECT_EQ(mechanism.loops[0].radii[2].constant(), 0.5);
}

/// First where the frame is, then where the import is in it, then where the joint is in that.
TEST(Import, OnATurnedFrameHangsOnAMountForEachTurn) {
  Files files;
  files.add("arm.toml", kArm)
      .add("model.toml",
           kHead + link("base", "lift", "world") +
               "[[frame]]\nname = \"flange\"\nbody = \"base\"\nposition = [1, 0, 0]\nrpy = [0.1, 0, 0]\n"
               "[[import]]\nfile = \"arm.toml\"\nparent = \"flange\"\nposition = [2, 0, 0]\nrpy = [0, 0.2, "
               "0]\n");
  const Mechanism mechanism = files.cleanly("model.toml");
  const Joint& shoulder = mechanism.joints[0];
  const auto carrying = [&](std::optional<BodyIndex> body) {
    for (const Joint& joint : mechanism.joints)
      if (joint.child == *body) return joint;
    return Joint();
  };
  const Joint second = carrying(shoulder.parent), first = carrying(second.parent),
              lift = carrying(first.parent);
  EXPECT_EQ(lift.name, "lift");
  EXPECT_EQ(first.placement.position[0].constant(), 1);
  EXPECT_EQ(first.placement.rotation.rpy[0].constant(), 0.1);
  EXPECT_EQ(second.placement.position[0].constant(), 2);
  EXPECT_EQ(second.placement.rotation.rpy[1].constant(), 0.2);
  EXPECT_EQ(shoulder.placement.position[2].constant(), 0.3);
}

TEST(Override, ChangesOneKeyAndLeavesTheOthers) {
  Files files;
  files.add("arm.toml", kArm)
      .add("model.toml", kHead +
                             "[parameters]\nload = 3\n[[import]]\nfile = \"arm.toml\"\n"
                             "[[override]]\nbody = \"upper\"\nmass = \"2*load\"\n"
                             "[[override]]\nbody = \"lower\"\nmass = \"load\"\n"
                             "[[override]]\njoint = \"shoulder\"\ndamping = 7\nrange = [-1, 1]\n"
                             "[[override]]\njoint = \"elbow\"\nsecond = { stiffness = 5 }\n");
  const Mechanism mechanism = files.cleanly("model.toml");
  const Body &upper = mechanism.bodies[0], &lower = mechanism.bodies[1];
  EXPECT_EQ(value(mechanism, upper.mass), 6);
  EXPECT_EQ(value(mechanism, upper.center_of_mass[0]), 0.25);
  EXPECT_EQ(value(mechanism, lower.mass), 3);
  // Of a box: m/12 (b² + c²).
  EXPECT_NEAR(value(mechanism, lower.inertia.xx), 3.0 / 12 * (0.01 + 0.01), 1e-15);
  EXPECT_NEAR(value(mechanism, lower.inertia.yy), 3.0 / 12 * (0.25 + 0.01), 1e-15);
  const Coordinate& shoulder = mechanism.joints[0].coordinates[0];
  EXPECT_EQ(value(mechanism, shoulder.damping), 7);
  EXPECT_EQ(value(mechanism, shoulder.initial_position), 0.2);
  EXPECT_EQ((*shoulder.range)[1], 1);
  EXPECT_EQ(mechanism.joints[0].placement.position[2].constant(), 0.3);
  EXPECT_EQ(value(mechanism, mechanism.joints[1].coordinates[0].damping), 0.1);
  EXPECT_EQ(value(mechanism, mechanism.joints[1].coordinates[1].stiffness), 5);
}

/// The robot's joints have actuators that nobody wrote: a motion or an actuator takes their place.
TEST(Override, OfAMotionTakesTheImpliedActuatorAway) {
  Files files;
  files.add("robot.urdf", support::read_file(kData + "robots/rail_arm.urdf"))
      .add("model.toml",
           kHead +
               "[import]\nfile = \"robot.urdf\"\n"
               "[[override]]\njoint = \"slide\"\nmotion = \"0.1*t\"\n"
               "[[actuator]]\njoint = \"pan\"\ngear_ratio = 50\n"
               "[[output]]\nname = \"torque\"\nkind = \"expression\"\nvalue = \"tool.x*pan\"\n");
  const Files::Result result = files.read("model.toml");
  ASSERT_TRUE(result.mechanism) << result.messages;
  const Mechanism& mechanism = *result.mechanism;
  EXPECT_TRUE(mechanism.joints[0].coordinates[0].motion);
  EXPECT_EQ(mechanism.actuators[0].name, "pan");
  EXPECT_EQ(mechanism.actuators[0].gear_ratio.constant(), 50);
  for (const Actuator& actuator : mechanism.actuators) EXPECT_NE(actuator.name, "slide");
}

TEST(Repeat, OfTwentyLinksIsTheChainWrittenByHand) {
  std::string written = kHead + link("link1", "hinge1", "world", "damping = 0.1\n");
  for (int i = 2; i <= 20; ++i) {
    const std::string n = std::to_string(i), before = std::to_string(i - 1);
    written += link("link" + n, "hinge" + n, "link" + before,
                    "position = [0, 0, -1]\ninitial_position = \"0.01*" + n + "\"\n") +
               "[[spring]]\nname = \"cord" + n + "\"\nfrom = \"world\"\nto = \"link" + n +
               "\"\nstiffness = 3\n\n";
  }
  const std::string repeated =
      kHead + link("link1", "hinge1", "world", "damping = 0.1\n") +
      "[[repeat]]\ncount = 19\nfirst = 2\nindex = \"n\"\n\n[[repeat.body]]\nname = \"link{n}\"\nmass = 1\n"
      "center_of_mass = [0, 0, -0.5]\n\n[[repeat.joint]]\nname = \"hinge{n}\"\ntype = \"revolute\"\nparent = "
      "\"link{n-1}\"\nchild = \"link{ n }\"\naxis = [0, 1, 0]\nposition = [0, 0, -1]\ninitial_position = "
      "\"0.01*{n}\"\n\n[[repeat.spring]]\nname = \"cord{n}\"\nfrom = \"world\"\nto = \"link{n}\"\nstiffness "
      "= 3\n";
  EXPECT_EQ(tests::to_toml(by_hand(repeated)), tests::to_toml(by_hand(written)));
}

TEST(Repeat, NamesCoordinatesInTermsOfCouplers) {
  std::string links = kHead;
  for (const char* name : {"j1", "j2", "k2", "k3"}) links += link(std::string("on_") + name, name, "world");
  const auto coupled = [](const std::string& a, const std::string& b) {
    return "coupler]]\nterms = { \"" + a + "\" = 1, \"" + b + "\" = -2 }\n\n";
  };
  EXPECT_EQ(tests::to_toml(by_hand(links + "[[repeat]]\ncount = 2\n[[repeat." + coupled("j{i}", "k{i+1}"))),
            tests::to_toml(by_hand(links + "[[" + coupled("j1", "k2") + "[[" + coupled("j2", "k3"))));
}

TEST(Repeat, KeepsTheOrderOfTheFile) {
  const Mechanism mechanism =
      by_hand(kHead + link("a", "j_a", "world") +
              "[[repeat]]\ncount = 2\n[[repeat.body]]\nname = \"p{i}\"\nmass = "
              "1\n[[repeat.body]]\nname = \"q{i+1}\"\nmass = 1\n"
              "[[repeat.joint]]\nname = \"jp{i}\"\ntype = \"prismatic\"\nparent = \"a\"\nchild = "
              "\"p{i}\"\n[[repeat.joint]]\nname = \"jq{i}\"\ntype = \"prismatic\"\nparent = "
              "\"a\"\nchild = \"q{i+1}\"\n\n" +
              link("z", "j_z", "world"));
  std::vector<std::string> names;
  for (const Body& body : mechanism.bodies) names.push_back(body.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "p1", "q2", "p2", "q3", "z"}));
}

TEST(Repeat, MayHoldImports) {
  Files files;
  files.add("arm.toml", kArm)
      .add("model.toml",
           kHead + link("base", "lift", "world") +
               "[[repeat]]\ncount = 3\n[[repeat.import]]\nfile = \"arm.toml\"\nprefix = \"arm{i}_\"\n"
               "parent = \"base\"\nposition = [\"0.5*{i}\", 0, 0]\n");
  const Mechanism mechanism = files.cleanly("model.toml");
  ASSERT_EQ(mechanism.bodies.size(), 7u);
  EXPECT_EQ(mechanism.bodies[4].name, "arm3_upper");
  EXPECT_EQ(value(mechanism, mechanism.joints[4].placement.position[0]), 1.5);
  EXPECT_EQ(mechanism.joints[4].parent, BodyIndex(6));
}

/// π r² with r = 0.1, and with r = 0.2.
TEST(DerivedParameter, FollowsWhatItNames) {
  const Mechanism mechanism = by_hand(
      kHead +
      "[parameters]\nweight = \"rho*area*l\"\narea = { value = \"pi*r^2\", unit = \"m^2\" }\n"
      "r = { value = 0.1, unit = \"m\" }\nl = { value = 2, unit = \"m\" }\nrho = { value = 1000, unit = "
      "\"kg/m^3\" }\n[[body]]\nname = \"b\"\nmass = \"weight\"\n[[joint]]\nname = \"j\"\ntype = "
      "\"prismatic\"\nparent = \"world\"\nchild = \"b\"\n");
  std::vector<std::string> names;
  for (const Parameter& parameter : mechanism.parameters) names.push_back(parameter.name);
  EXPECT_EQ(names, (std::vector<std::string>{"r", "l", "rho"}));
  EXPECT_NEAR(value(mechanism, mechanism.bodies[0].mass), 62.83185307179586, 1e-12);
  EXPECT_NEAR(value(mechanism, mechanism.bodies[0].mass, {0.2, 2, 1000}), 251.3274122871834, 1e-12);
}

TEST(HostileImport, IsRefusedWithoutACrash) {
  Files files;
  std::string deep;
  for (int i = 0; i < 12; ++i)
    files.add("deep" + std::to_string(i) + ".toml",
              "[import]\nfile = \"deep" + std::to_string(i + 1) + ".toml\"\n");
  files.add("big.toml", std::string(5'000'000, '\n') + "a = 1\n")
      .add("binary.urdf", std::string("<robot\0>", 8))
      .add("self.toml", kHead + "[import]\nfile = \"../" + files.path("").parent_path().filename().string() +
                            "/self.toml\"\n");
  const auto refused = [&](const std::string& file) {
    files.add("model.toml", kHead + "[import]\nfile = \"" + file + "\"\n");
    const Files::Result result = files.read("model.toml");
    EXPECT_FALSE(result.mechanism) << file;
    return result.messages;
  };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(refused("deep0.toml"), "files import each other deeper than 8 levels");
  has(refused("big.toml"),
      "big.toml: error: the file has 5000006 bytes, more than the 4000000 that are read\n");
  has(refused("binary.urdf"), "binary.urdf:1:7: error: the file is not text: control character 0x00");
  has(refused("self.toml"), "imports itself");
  has(refused("/dev/zero"), "it is no regular file");
  has(refused("."), "it is a folder");
  has(refused(""), "'file' of an import is empty");
}

/// Two imports in each of eight files would be 256 files.
TEST(HostileImport, ReadsNoMoreThanAHundredFiles) {
  Files files;
  for (int i = 0; i < 8; ++i) {
    std::string text = i == 0 ? kHead : "";
    for (const char* prefix : {"a_", "b_"})
      text += "[[import]]\nfile = \"f" + std::to_string(i + 1) + ".toml\"\nprefix = \"" + prefix + "\"\n";
    files.add("f" + std::to_string(i) + ".toml", text);
  }
  files.add("f8.toml", link("x", "j", "world"));
  EXPECT_NE(files.read("f0.toml").messages.find("too many files are imported: no more than 100 are read"),
            std::string::npos);
}

}  // namespace
}  // namespace jourdain::model
