// Robot files as they are found: what is read leniently, how that is said, and how it is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

class RobotFiles : public testing::Test {
 protected:
  support::ProcessResult jourdain(const std::string& file, const std::string& text,
                                  const std::vector<std::string>& options) const {
    support::write_file(in_folder(file), text);
    std::vector<std::string> command = {"env", "-C", folder_.path(), JOURDAIN_BINARY};
    command.insert(command.end(), options.begin(), options.end());
    command.push_back(file);
    return support::run_process(command);
  }
  std::string in_folder(const std::string& name) const { return folder_.path() + "/" + name; }

 private:
  support::TemporaryFolder folder_;
};

/// A pendulum about that axis with a moment −0.1 kg m² about x, placed with that pitch.
std::string pendulum(const std::string& axis, const std::string& pitch = "0",
                     const std::string& ixx = "-0.1") {
  return fmt::format(R"(<robot name="pendulum">
  <link name="base"/>
  <link name="bob"><inertial><origin xyz="0.2 0 0"/><mass value="1"/>
    <inertia ixx="{}" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <joint name="hinge" type="continuous"><origin rpy="0 {} 0"/><parent link="base"/><child link="bob"/><axis xyz="{}"/></joint>
</robot>
)",
                     ixx, pitch, axis);
}

TEST_F(RobotFiles, IndefiniteInertiasAreUsedAndSaidWhereTheyDoNoHarm) {
  expect(jourdain("p.urdf", pendulum("0 0 1"), {"compile", "-o", "out"}), 0,
         "p.urdf:4:5: warning: inertia of body 'bob'");
  EXPECT_NE(
      support::read_file(in_folder("out/pendulum.hpp")).find("M need not be positive definite everywhere"),
      std::string::npos);
  expect(jourdain("p.urdf", pendulum("1 0 0"), {"check"}), 1,
         "error: joint 'hinge' moves a negative inertia");
}

/// In a gimbal's lock the second axis is 1e-33 beside one of the frame before: not along it.
TEST_F(RobotFiles, AxesBesideOthersAreNotAlongThem) {
  const std::string inertia =
      R"(<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0.1"/></inertial></link>)";
  const std::string links =
      R"(<robot name="r"><link name="base"/><link name="a"><inertial><mass value="1"/>)" + inertia +
      R"(<link name="b"><inertial><origin xyz="1 0 0"/><mass value="1"/>)" + inertia;
  for (const std::string rpy : {"1.5707963267948966 1.5707963267948966 0", "1.57079632679 1.57079632679 0",
                                "-1.5707963267948966 1.5707963267948966 0.4"}) {
    const std::string joints =
        R"(<joint name="j" type="revolute"><parent link="base"/><child link="a"/><origin rpy=")" + rpy +
        R"("/><axis xyz="0 1 0"/></joint><joint name="k" type="revolute"><parent link="a"/><child link="b"/>)"
        R"(<axis xyz="0 0 1"/></joint></robot>)";
    expect(jourdain("r.urdf", links + joints, {"check", "--no-snap"}), 0, "ok: r");
  }
}

TEST_F(RobotFiles, StrictTakesNoWarnings) {
  expect(jourdain("p.urdf", pendulum("0 0 1"), {"check", "--strict"}), 1, "--strict takes no warnings");
  expect(jourdain("p.urdf", pendulum("0 0 1", "0", "0.1"), {"check", "--strict"}), 0, "ok: pendulum");
}

TEST_F(RobotFiles, SnappingSaysWhatItDoes) {
  const std::string text = pendulum("0 0 1", "1.5708", "0.1");
  const std::string effect = "note: reading angles and axes as right changes accelerations by ";
  expect(jourdain("p.urdf", text, {"check"}), 0, effect);
  EXPECT_EQ(jourdain("p.urdf", text, {"check", "--no-snap"}).output.find(effect), std::string::npos);
  EXPECT_EQ(jourdain("p.urdf", text, {"check", "--snap", "1e-6"}).output.find(effect), std::string::npos);
  expect(jourdain("p.urdf", text, {"check", "--snap", "1"}), 2, "--snap");
  expect(jourdain("p.urdf", text, {"check", "--snap", "1e-3", "--no-snap"}), 2, "--no-snap");
}

std::string with_parameter(const std::string& mass, const std::string& length) {
  return fmt::format(R"([model]
name = "bob"
[parameters]
m = {}
[[body]]
name = "bob"
mass = "m"
center_of_mass = [0, 0, {}]
[[joint]]
name = "hinge"
type = "revolute"
parent = "world"
child = "bob"
axis = [0, 1, 0]
initial_position = 0.5
)",
                     mass, length);
}

TEST_F(RobotFiles, ParametersThatAreSetAreCheckedLikeThoseOfTheFile) {
  expect(jourdain("m.toml", with_parameter("-1", "-1"), {"check"}), 1, "mass of body 'bob' is negative");
  const auto set = [this](const char* value) {
    return jourdain("m.toml", with_parameter("1", "-1"), {"simulate", "--duration", "0.1", "--set", value});
  };
  expect(set("m=-1"), 2, "mass of body 'bob' is negative");
  expect(set("m=0"), 2, "moves no inertia");
  expect(set("m=2"), 0, "");
}

/// All six rows of a weld are one connection: those that hold nothing are left out, also where rounded poses disagree
/// by 1e-17 and where the sixth row stands by itself. A hinge, a slide or a ball may be locked by one.
TEST_F(RobotFiles, WeldsMayHaveRowsThatHoldNothing) {
  const std::string inertial = R"(<inertial pos="-0.06 0.17 -0.11" mass="1" diaginertia=".2 .25 .3"/>)";
  const auto locked = [&](const std::string& place, const std::string& joint) {
    return R"(<mujoco><worldbody><body name="b0" euler="-46.989 -80.10 54.877"><joint name="j0" axis="-0.76 -0.06 -0.28"/>)" +
           inertial + "<body name=\"b1\" " + place + "><joint name=\"j1\" " + joint + "/>" + inertial +
           R"(</body></body></worldbody><equality><weld body1="b0" body2="b1"/></equality></mujoco>)";
  };
  for (const char* place :
       {"", R"(pos="0.11 0.23 -0.07" euler="31 17 5")", R"(euler="-75.787 11.644 -25.206")"})
    for (const char* joint :
         {R"(axis="0 1 0")", R"(axis="0.3 0.2 0.7" pos="0.02 0.17 0.05")",
          R"(type="slide" axis="0.3 0.2 0.7")", R"(type="ball")", R"(type="ball" pos="0.02 0.17 0.05")"})
      expect(jourdain("w.xml", locked(place, joint), {"check", "--name", "w"}), 0, "1 degree of freedom");
  // 0.076 + 0.101 is not 0.177: 1.4e-17 m.
  expect(
      jourdain("w.xml",
               R"(<mujoco><worldbody><body name="b0" pos="0.076 0 0.229"><joint axis="0 1 0"/>)" + inertial +
                   R"(<body name="b1" pos="0.101 0 -0.144"><joint type="slide" axis="1 0 0"/>)" + inertial +
                   R"(</body></body></worldbody><equality><weld body1="b1"/></equality></mujoco>)",
               {"check", "--name", "w"}),
      0, "0 degrees of freedom");
  std::string chain, ends;
  for (const char* body : {"a", "b", "c", "e"}) {
    chain += fmt::format("<body name=\"{0}\" pos=\"{1} 0\"><joint name=\"j{0}\" axis=\"0 0 1\"/>{2}", body,
                         chain.empty()              ? "0 0"
                         : body == std::string("c") ? "0.1 0.4"
                                                    : "0.3 0.1",
                         inertial);
    ends += "</body>";
  }
  expect(jourdain("w.xml",
                  "<mujoco><worldbody>" + chain + ends +
                      "</worldbody><equality><weld body1=\"e\"/></equality></mujoco>",
                  {"check", "--name", "w"}),
         0, "1 degree of freedom");
}

TEST_F(RobotFiles, NumbersThatDoubleHasNoRoomForAreTheDescriptions) {
  expect(jourdain("m.toml", with_parameter("1", "-1e-155"), {"check"}), 1, "m.toml:1:1: error: ");
}

}  // namespace
}  // namespace jourdain::tests
