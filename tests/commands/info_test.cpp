// What `info` tells of a model, as tables and as JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

support::ProcessResult info(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {"env", "-C", JOURDAIN_SOURCE_DIR, JOURDAIN_BINARY, "info"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

std::string text_of(const std::vector<std::string>& arguments) {
  const support::ProcessResult result = info(arguments);
  EXPECT_EQ(result.status, 0) << result.output;
  return result.output;
}

json json_of(const std::string& model) {
  const support::ProcessResult result =
      support::run_process({"env", "-C", JOURDAIN_SOURCE_DIR, "sh", "-c",
                            std::string(JOURDAIN_BINARY) + " info --json \"" + model + "\" 2>/dev/null"});
  EXPECT_EQ(result.status, 0) << result.output;
  return json::parse(result.output);
}

std::vector<std::string> names(const json& list) {
  std::vector<std::string> texts;
  for (const json& entry : list) texts.push_back(entry["name"]);
  return texts;
}

/// The line of a text that begins with these words, with single blanks between words.
std::string line_with(const std::string& text, const std::string& beginning) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string plain;
    for (std::string word; words >> word;) plain += (plain.empty() ? "" : " ") + word;
    if (plain.starts_with(beginning)) return plain;
  }
  return "no line with " + beginning;
}

/// A robot with limits and a name that JSON must escape.
std::string robot(const support::TemporaryFolder& folder) {
  const std::string path = folder.path() + "/robot.urdf";
  const std::string inertial =
      "<inertial><origin xyz=\"0 0.25 0\"/><mass value=\"2\"/>"
      "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>";
  support::write_file(
      path,
      "<robot name=\"robot\"><link name=\"base\"/>"
      "<link name=\"arm &quot;left&quot; \\ 手\">" +
          inertial + "</link><link name=\"hand\">" + inertial +
          "</link><joint name=\"shoulder\" type=\"revolute\"><origin xyz=\"0 0 0.5\" rpy=\"0.1 0 0\"/>"
          "<parent link=\"base\"/><child link=\"arm &quot;left&quot; \\ 手\"/><axis xyz=\"0 1 0\"/>"
          "<limit lower=\"-1.5\" upper=\"2.5\" velocity=\"3\" effort=\"40\"/></joint>"
          "<joint name=\"wrist\" type=\"continuous\"><parent link=\"arm &quot;left&quot; \\ 手\"/>"
          "<child link=\"hand\"/><axis xyz=\"1 0 0\"/><limit effort=\"5\"/></joint></robot>");
  return path;
}

TEST(Info, ShowsWhatAModelFileHas) {
  const std::string text = text_of({"models/cart_pole.toml"});
  for (const char* part :
       {"slide [prismatic (1, 0, 0), y[0]] -> cart", "2 degrees of freedom",
        "root cart; gravity (0, 0, -9.8) m/s^2", "forward_dynamics", "left out", "hoist", "assumes: "})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_EQ(line_with(text, "pole cart"), "pole cart hinge 0.1 (0, 0, 0.5) pole_mass, pole_half_length");
  EXPECT_EQ(line_with(text, "y[1]"), "y[1] hinge rad 0.0523599");
  EXPECT_EQ(line_with(text, "z[0]"), "z[0] slide m/s 0");
  EXPECT_EQ(line_with(text, "u[0]"), "u[0] push N slide");
  EXPECT_EQ(line_with(text, "pole_mass"), "pole_mass 0.1 kg mass of the pole");
  for (const char* absent : {"\n  frames", "\n  outputs", "\n  limits", "range"})
    EXPECT_THAT(text, Not(HasSubstr(absent)));
}

TEST(Info, ShowsLimitsOfARobot) {
  const support::TemporaryFolder folder;
  const std::string text = text_of({robot(folder)});
  EXPECT_EQ(line_with(text, "limits"), "limits (not in the equations) lower upper velocity effort units");
  EXPECT_EQ(line_with(text, "shoulder -1.5"), "shoulder -1.5 2.5 3 40 rad, rad/s, N m");
  EXPECT_EQ(line_with(text, "wrist 5"), "wrist 5 rad, rad/s, N m");
  EXPECT_EQ(line_with(text, "shoulder revolute"), "shoulder revolute (0, 1, 0) (0, 0, 0.5) (0.1, 0, 0)");
  EXPECT_THAT(text_of({robot(folder), "--lock", "shoulder"}), Not(HasSubstr("40  rad")));
}

TEST(Info, ColumnsAreAligned) {
  const support::TemporaryFolder folder;
  std::istringstream lines(text_of({robot(folder)}));
  std::vector<std::size_t> starts;
  bool in_links = false;
  for (std::string line; std::getline(lines, line);) {
    in_links = line.starts_with("  links") || (in_links && line.starts_with("    "));
    if (!in_links) continue;
    std::size_t bytes_beyond = 0;
    for (const char c : line) bytes_beyond += (static_cast<unsigned char>(c) & 0xc0) == 0x80;
    const std::size_t at = line.find(line.starts_with("  links") ? "centre" : "(0,");
    starts.push_back(at - (line.find("手") < at ? bytes_beyond : 0));
  }
  ASSERT_EQ(starts.size(), 4u);
  EXPECT_THAT(starts, testing::Each(starts[0]));
}

TEST(InfoJson, HasTheFactsOfARobot) {
  const support::TemporaryFolder folder;
  const json facts = json_of(robot(folder));
  EXPECT_EQ(facts["name"], "robot");
  EXPECT_EQ(facts["model"], "robot.urdf");
  EXPECT_EQ(facts["roots"], json({"base"}));
  EXPECT_EQ(facts["degrees_of_freedom"], 2);
  const json& arm = facts["links"][1];
  EXPECT_EQ(arm["name"], "arm \"left\" \\ 手");
  EXPECT_EQ(arm["parent"], "base");
  EXPECT_EQ(arm["joint"], "shoulder");
  EXPECT_EQ(arm["mass"], 2.0);
  EXPECT_EQ(arm["center_of_mass"], json({0, 0.25, 0}));
  EXPECT_FALSE(arm.contains("depends_on"));
  EXPECT_EQ(names(facts["joints"]), (std::vector<std::string>{"base_to_world", "shoulder", "wrist"}));
  const json limits = {{"lower", -1.5},
                       {"upper", 2.5},
                       {"velocity", 3.0},
                       {"effort", 40.0},
                       {"units", {"rad", "rad/s", "N m"}}};
  EXPECT_EQ(facts["joints"][1]["limits"], limits);
  EXPECT_EQ(facts["joints"][2]["limits"], json({{"effort", 5.0}, {"units", {"rad", "rad/s", "N m"}}}));
  EXPECT_EQ(
      facts["positions"][0],
      json({{"index", 0}, {"name", "shoulder"}, {"unit", "rad"}, {"joint", "shoulder"}, {"initial", 0.0}}));
  EXPECT_EQ(facts["velocities"][1]["unit"], "rad/s");
  EXPECT_EQ(facts["inputs"][1]["coordinate"], "wrist");
  EXPECT_EQ(facts["operations"]["forward_dynamics"].contains("arithmetic"), true);
  EXPECT_TRUE(facts["frames"].empty() && facts["outputs"].empty() && facts["parameters"].empty());
}

TEST(InfoJson, NamesEntriesOfQuaternions) {
  const json facts = json_of("models/quadrotor.toml");
  EXPECT_THAT(names(facts["positions"]),
              testing::ElementsAre("root_x", "root_y", "root_z", "root_qw", "root_qx", "root_qy", "root_qz"));
  EXPECT_EQ(facts["positions"][2]["unit"], "m");
  EXPECT_EQ(facts["positions"][3]["unit"], "1");
  EXPECT_EQ(facts["positions"][3]["joint"], "root");
  EXPECT_THAT(names(facts["velocities"]),
              testing::ElementsAre("root_vx", "root_vy", "root_vz", "root_wx", "root_wy", "root_wz"));
  EXPECT_EQ(facts["velocities"][5]["unit"], "rad/s");
  double square = 0;
  for (int i = 3; i < 7; ++i) square += std::pow(facts["positions"][i]["initial"].get<double>(), 2);
  EXPECT_NEAR(square, 1, 1e-12);
  EXPECT_EQ(facts["inputs"].size(), 4u);
}

TEST(InfoJson, HasClosedLoopsAndOutputs) {
  const json facts = json_of("models/four_bar.toml");
  EXPECT_THAT(names(facts["positions"]), testing::ElementsAre("crank", "coupler", "rocker"));
  EXPECT_THAT(names(facts["velocities"]), testing::ElementsAre("crank"));
  EXPECT_EQ(facts["loops"][0]["type"], "planar_pin");
  EXPECT_EQ(facts["loops"][0]["from"], "rocker_end");
  EXPECT_EQ(facts["dependent_positions"], json({"coupler", "rocker"}));
  EXPECT_THAT(names(facts["frames"]), testing::Contains("coupler_end"));
  const json& pose = facts["outputs"][0];
  EXPECT_EQ(pose["name"], "coupler_curve");
  EXPECT_EQ(pose["kind"], "pose");
  ASSERT_EQ(pose["numbers"].size(), 12u);
  EXPECT_EQ(pose["numbers"][1], json({{"name", "coupler_curve.position[1]"}, {"unit", "m"}}));
  EXPECT_EQ(pose["numbers"][11]["name"], "coupler_curve.rotation[2][2]");
  EXPECT_EQ(facts["parameters"][0]["name"], "bearing");
  EXPECT_EQ(facts["parameters"][0]["value"], 0.02);
}

/// Where loops close is where the simulation starts.
TEST(InfoJson, InitialValuesAreThoseOfTheEmittedModel) {
  for (const std::string model : {"four_bar", "double_wishbone", "crane", "cart_pole"}) {
    const std::string path = "models/" + model + ".toml";
    const support::TemporaryFolder folder;
    const support::ProcessResult run =
        support::run_process({"env", "-C", JOURDAIN_SOURCE_DIR, JOURDAIN_BINARY, "simulate", path,
                              "--duration", "1e-3", "--output", folder.path() + "/a.csv"});
    ASSERT_EQ(run.status, 0) << run.output;
    std::istringstream text(support::read_file(folder.path() + "/a.csv"));
    std::string line, field;
    std::getline(text, line);
    std::getline(text, line);
    std::istringstream fields(line);
    std::getline(fields, field, ',');
    const json facts = json_of(path);
    for (const char* kind : {"positions", "velocities"})
      for (const json& entry : facts[kind]) {
        std::getline(fields, field, ',');
        EXPECT_NEAR(std::stod(field), entry["initial"].get<double>(), 1e-12) << model << " " << entry["name"];
      }
  }
}

TEST(InfoJson, IsTheSameOnEveryRunAndNothingElseIsPrinted) {
  const std::string text = text_of({"models/pendulum.toml", "--json"});
  EXPECT_EQ(text_of({"models/pendulum.toml", "--json"}), text);
  EXPECT_EQ(text.front(), '{');
  EXPECT_EQ(json::parse(text)["links"][0]["depends_on"], json({"m", "l"}));
  EXPECT_EQ(info({"models/nothing.toml", "--json"}).status, 3);
}

}  // namespace
}  // namespace jourdain::tests
