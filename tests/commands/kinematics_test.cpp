// Functions of the kinematics on the command line, as runtime/embedding.md asks for them for a controller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>
#include <sstream>
#include <utility>

#include "model/matrix3.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

using testing::HasSubstr;

constexpr double kQuarter = std::numbers::pi / 2;

class Kinematics : public testing::Test {
 protected:
  /// In the project's folder.
  static support::ProcessResult run(std::vector<std::string> command) {
    command.insert(command.begin(), {"env", "-C", JOURDAIN_SOURCE_DIR});
    return support::run_process(command);
  }
  static support::ProcessResult compile(const std::vector<std::string>& options) {
    std::vector<std::string> command = {JOURDAIN_BINARY, "compile", "tests/data/robots/rail_arm.urdf"};
    command.insert(command.end(), options.begin(), options.end());
    return run(command);
  }
  std::string in_folder(const std::string& name) const { return folder_.path() + "/" + name; }

  support::TemporaryFolder folder_;
};

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return "";
  return text.substr(from + begin.size(), text.find(end, from + begin.size()) - from - begin.size());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// The four commands and the program between them, as they stand there.
TEST_F(Kinematics, ControllerOfThePageRuns) {
  const std::string section =
      between(support::read_file(JOURDAIN_SOURCE_DIR "/runtime/embedding.md"), "## Kinematics\n", "\n## ");
  support::write_file(in_folder("controller.cpp"), between(section, "```cpp\n", "```"));
  std::istringstream lines(between(section, "four commands:\n\n", "\n\nwhere"));
  std::string output;
  int commands = 0;
  for (std::string line; std::getline(lines, line); ++commands) {
    std::string command = replaced(line, "    ", "");
    command = replaced(command, "jourdain ", JOURDAIN_BINARY " ");
    command = replaced(command, "tests/data", JOURDAIN_SOURCE_DIR "/tests/data");
    const support::ProcessResult result =
        support::run_process({"env", "-C", folder_.path(), "sh", "-c", command});
    ASSERT_EQ(result.status, 0) << command << "\n" << result.output;
    output = result.output;
  }
  EXPECT_EQ(commands, 4);
  double x = 0, y = 0, z = 0, upward = 0;
  ASSERT_EQ(
      std::sscanf(output.c_str(), "tool at %lf %lf %lf\nit accelerates upward with %lf", &x, &y, &z, &upward),
      4)
      << output;
  // The origins and angles of the file's joints, one after the other; it starts with all coordinates at zero.
  const std::pair<model::Numbers3, model::Numbers3> joints[] = {
      {{0, 0, 0.1}, {0, kQuarter, 0}},           {{0, 0, 0.163}, {kQuarter, 0, 0}},
      {{0, 0.138, 0}, {0, kQuarter, -kQuarter}}, {{0.425, 0, -0.12}, {0, 0, 0}},
      {{0.392, 0, 0.01}, {0.3, 0, 0}},           {{0.09, 0.02, 0}, {-kQuarter, 0, 2 * kQuarter}},
      {{0, 0.01, 0.08}, {0.2, 0, 1.1}}};
  model::Numbers3 tool{};
  model::Matrix3 R = model::kIdentity3;
  for (const auto& [origin, rpy] : joints) {
    tool = model::sum(tool, model::product(R, origin));
    R = model::product(R, model::rotation_from_rpy(rpy));
  }
  EXPECT_NEAR(x, tool[0], 1e-5);  // six digits are printed
  EXPECT_NEAR(y, tool[1], 1e-5);
  EXPECT_NEAR(z, tool[2], 1e-5);
  EXPECT_GT(upward, 0);
}

TEST_F(Kinematics, MessagesSayWhatThereIs) {
  const auto refused = [&](const std::vector<std::string>& options, const std::string& part) {
    std::vector<std::string> all = {"-o", in_folder("out")};
    all.insert(all.end(), options.begin(), options.end());
    const support::ProcessResult result = compile(all);
    EXPECT_EQ(result.status, 2) << result.output;
    EXPECT_THAT(result.output, HasSubstr(part));
  };
  refused({"--frame", "tool"}, "--frame tool: write NAME=FRAME, as in tool=hand");
  refused({"--frame", "2=tool"}, "'2' is not an identifier");
  refused({"--frame", "t=toool"}, "no frame or body 'toool'; did you mean 'tool'?");
  refused({"--frame", "t=tool:posee"}, "there is no quantity 'posee'; did you mean 'pose'?");
  refused({"--frame", "t=tool:pose+pose"}, "'pose' stands twice in 'pose+pose'");
  refused({"--frame", "t=tool:momentum"}, "'momentum' is of the whole mechanism, not of a frame");
  refused({"--frame", "t=tool:pose:local"}, "no axes 'local'; there are world_aligned, frame, world");
  refused({"--frame", "t=tool:pose:world:x"}, "more than FRAME:QUANTITIES:AXES");
  refused({"--frame", "t=tool", "--frame", "t=hand"}, "there are two functions 't_pose'");
  refused({"--functions", "gravity_compensatio"}, "did you mean 'gravity_compensation'?");
}

TEST_F(Kinematics, OnlyWhatIsAskedForIsEmitted) {
  ASSERT_EQ(
      compile({"-o", in_folder("a"), "--functions", "momentum", "--frame", "t=hand:velocity:frame"}).status,
      0);
  const std::string header = support::read_file(in_folder("a/rail_arm.hpp"));
  EXPECT_THAT(header, HasSubstr("t_velocity("));
  EXPECT_THAT(header, HasSubstr("momentum("));
  EXPECT_THAT(header, Not(HasSubstr("mass_matrix(")));
  EXPECT_THAT(header, HasSubstr("Pinocchio: LOCAL;"));
}

/// Accelerations follow from time there, and nothing is given.
TEST_F(Kinematics, OfWhatOnlyMovesAsPrescribedTakeNoAccelerations) {
  const std::string model = in_folder("rod.toml");
  support::write_file(model,
                      "[model]\nname = \"rod\"\n[[body]]\nname = \"b\"\nmass = 1\n[[joint]]\nname = "
                      "\"j\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = \"b\"\nmotion = "
                      "\"0.1*sin(t)\"\n[[kinematics]]\nname = \"tip\"\nframe = \"b\"\nquantities = "
                      "[\"acceleration\", \"imu\"]\n");
  for (const std::string language : {"c++", "c"}) {
    const support::ProcessResult result =
        run({JOURDAIN_BINARY, "compile", model, "-o", folder_.path(), "--language", language});
    ASSERT_EQ(result.status, 0) << result.output;
  }
  const std::string header = support::read_file(in_folder("rod.hpp"));
  EXPECT_THAT(header,
              HasSubstr("void tip_acceleration(const Model<Real>& model, const State<Real>& state, Real"));
  EXPECT_THAT(header, testing::Not(HasSubstr("given zdot")));
}

/// Names of links in a world of SDF hold pairs of colons.
TEST_F(Kinematics, FramesOfModelsInAWorldHaveTheirNames) {
  const std::string model = in_folder("world.sdf");
  support::write_file(
      model,
      "<sdf version=\"1.9\"><world name=\"w\"><model name=\"arm\"><link name=\"a\"><inertial><mass>1"
      "</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link><joint "
      "name=\"j\" type=\"revolute\"><parent>world</parent><child>a</child></joint></model></world>"
      "</sdf>");
  const support::ProcessResult result =
      run({JOURDAIN_BINARY, "compile", model, "-o", folder_.path(), "--frame", "t=arm::a:pose,jacobian:frame",
           "--frame", "u=arm::a"});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::string header = support::read_file(in_folder("w.hpp"));
  for (const char* function : {"void t_pose(", "void t_jacobian(", "void u_pose("})
    EXPECT_THAT(header, HasSubstr(function));
}

}  // namespace
}  // namespace jourdain::tests
