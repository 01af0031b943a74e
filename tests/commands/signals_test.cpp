// What `simulate` writes and draws: names of columns, plots of signals.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

class Signals : public testing::Test {
 protected:
  std::string in_folder(const std::string& name) const { return folder_.path() + "/" + name; }

  /// Runs `jourdain simulate` for half a second in the folder.
  support::ProcessResult simulate(const std::string& model, const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {"env", "-C",         folder_.path(), JOURDAIN_BINARY, "simulate",
                                        model, "--duration", "0.5",          "--output",      "a.csv"};
    command.insert(command.end(), more.begin(), more.end());
    return support::run_process(command);
  }

  void expect(const support::ProcessResult& result, int status, const std::string& part) {
    EXPECT_EQ(result.status, status) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << "no '" << part << "' in\n" << result.output;
  }

  std::vector<std::string> columns() const {
    std::istringstream text(support::read_file(in_folder("a.csv")));
    std::string header, name;
    std::getline(text, header);
    std::istringstream names(header);
    std::vector<std::string> list;
    while (std::getline(names, name, ',')) list.push_back(name);
    return list;
  }

  /// Titles of the plot's axes and curves.
  bool draws(const std::string& file, const std::string& text) const {
    return support::read_file(in_folder(file)).find(">" + text + "<") != std::string::npos;
  }

  const std::string four_bar_ = JOURDAIN_SOURCE_DIR + std::string("/models/four_bar.toml");
  const support::TemporaryFolder folder_;
};

TEST_F(Signals, StatesHaveTheirOwnNames) {
  const std::string servo_arm = JOURDAIN_SOURCE_DIR + std::string("/models/servo_arm.toml");
  expect(simulate(servo_arm, {"--method", "rodas4", "--plot", "current", "p.svg"}), 0, "wrote a.csv, p.svg");
  const std::vector<std::string> names = columns();
  EXPECT_EQ(std::count(names.begin(), names.end(), "current"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "current_velocity"), 0);
  const support::ProcessResult drawn =
      support::run_process({"env", "-C", folder_.path(), JOURDAIN_BINARY, "ensemble", servo_arm, "--states",
                            "8", "--duration", "0.01", "--step", "1e-4", "--spread", "current=uniform(0.5)"});
  expect(drawn, 0, "current_at_start, A");
}

TEST_F(Signals, InputsOutputsAndEnergiesAreDrawn) {
  expect(simulate(four_bar_, {"--constant-input", "0.3", "--plot", "motor_input", "coupler_curve.position",
                              "rocker*", "total_energy", "p.svg"}),
         0, "wrote a.csv, p.svg");
  for (const char* name : {"motor_input", "coupler_curve.position[0]", "coupler_curve.position[2]", "rocker",
                           "rocker_angle", "total_energy"})
    EXPECT_TRUE(draws("p.svg", name)) << name;
  EXPECT_FALSE(draws("p.svg", "crank"));
  EXPECT_FALSE(draws("p.svg", "coupler_curve.rotation[0][0]"));
}

TEST_F(Signals, EachUnitHasItsPlot) {
  const auto panels = [&](const std::vector<std::string>& signals) {
    std::vector<std::string> options = {"--plot", "p.svg"};
    options.insert(options.end(), signals.begin(), signals.end());
    expect(simulate(four_bar_, options), 0, "p.svg");
    const std::string text = support::read_file(in_folder("p.svg"));
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(">t, s<", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(panels({}), 1u);
  EXPECT_EQ(panels({"crank", "crank_velocity", "rocker"}), 2u);
  EXPECT_TRUE(draws("p.svg", "rad") && draws("p.svg", "rad/s"));
  EXPECT_EQ(panels({"motor_input", "kinetic_energy", "coupler_curve"}), 4u);
  EXPECT_TRUE(draws("p.svg", "N m") && draws("p.svg", "J") && draws("p.svg", "without unit"));
}

TEST_F(Signals, AreDrawnWhetherTheyAreWrittenOrNot) {
  expect(simulate(four_bar_, {"--outputs", "rocker_angle", "--plot", "coupler_curve.position[1]"}), 0,
         "four_bar.svg");
  EXPECT_TRUE(draws("four_bar.svg", "coupler_curve.position[1]"));
  const std::vector<std::string> names = columns();
  EXPECT_EQ(names.back(), "rocker_angle");
  EXPECT_EQ(std::count(names.begin(), names.end(), "coupler_curve.position[1]"), 0);
}

TEST_F(Signals, ThatAreUnknownAreNamed) {
  expect(simulate(four_bar_, {"--plot", "roker", "p.svg"}), 2, "no signal 'roker'; did you mean 'rocker'?");
  expect(simulate(four_bar_, {"--plot", "joint*", "p.svg"}), 2, "no signal 'joint*'; there are crank, ");
  expect(simulate(four_bar_, {"--plot", "a.svg", "b.svg"}), 2, "two files");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Signals, WithoutAFiniteValueMakeNoPlot) {
  support::write_file(in_folder("m.toml"),
                      "[model]\nname = \"m\"\n[[input]]\nname = \"u\"\n[[body]]\nname = \"b\"\nmass = "
                      "1\n[[joint]]\nname = \"s\"\n"
                      "type = \"prismatic\"\nparent = \"world\"\nchild = \"b\"\n"
                      "[[output]]\nname = \"root\"\nkind = \"expression\"\nvalue = \"sqrt(u)\"\n");
  const support::ProcessResult result =
      simulate("m.toml", {"--constant-input", "-1", "--plot", "root", "p.svg"});
  expect(result, 0, "no plot: no value");
  EXPECT_FALSE(fs::exists(in_folder("p.svg")));
}

/// A slide that is called like the time, with a second one, an input and outputs that are called like each
/// other's columns.
TEST_F(Signals, HaveColumnsOfDifferentNames) {
  std::string text = "[model]\nname = \"m\"\n";
  for (const std::string name : {"time", "time_velocity", "total_energy"})
    text += fmt::format(
        "[[body]]\nname = \"body_{0}\"\nmass = 1\n[[joint]]\nname = \"{0}\"\ntype = \"prismatic\"\n"
        "parent = \"world\"\nchild = \"body_{0}\"\ninitial_position = {1}\n",
        name, name.size());
  text += "[[actuator]]\njoint = \"time\"\nname = \"pull\"\n";
  for (const std::string name : {"pull_input", "time", "time_output", "kinetic_energy"})
    text += fmt::format("[[output]]\nname = \"{}\"\nkind = \"expression\"\nvalue = \"{}\"\n", name,
                        100 + name.size());
  support::write_file(in_folder("m.toml"), text);
  const support::ProcessResult result = simulate("m.toml");
  expect(result, 0, "note: the output 'time' is called 'time_output_2' here: the name is taken");
  expect(result, 0, "note: the position 'time' is called 'time_position' here");
  const std::vector<std::string> wanted = {"time",
                                           "time_position",
                                           "time_velocity",
                                           "total_energy_position",
                                           "time_velocity_2",
                                           "time_velocity_velocity",
                                           "total_energy_velocity",
                                           "kinetic_energy",
                                           "potential_energy",
                                           "total_energy",
                                           "pull_input",
                                           "pull_input_output",
                                           "time_output_2",
                                           "time_output",
                                           "kinetic_energy_output"};
  EXPECT_EQ(columns(), wanted);
  std::istringstream lines(support::read_file(in_folder("a.csv")));
  std::string row;
  std::getline(lines, row);
  std::getline(lines, row);
  EXPECT_EQ(row.substr(0, row.find(",0,")), "0,4,13,12");
  EXPECT_TRUE(row.ends_with(",110,104,111,114")) << row;
  expect(simulate("m.toml", {"--outputs", "time_output"}), 0, "wrote");
  EXPECT_EQ(columns().back(), "time_output");
}

}  // namespace
}  // namespace jourdain::tests
