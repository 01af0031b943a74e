// What drives a simulation: tables, expressions, followed motions, parameters; and what is said where they are wrong.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

class DrivenRuns : public testing::Test {
 protected:
  support::ProcessResult simulate(const std::string& model, std::vector<std::string> arguments) {
    std::vector<std::string> command = {"env",      "-C",  JOURDAIN_SOURCE_DIR, JOURDAIN_BINARY,
                                        "simulate", model, "--output",          csv()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return support::run_process(command);
  }

  /// Field `column` of the last row of the CSV file.
  double last(int column) {
    const std::string text = support::read_file(csv());
    std::istringstream row(text.substr(text.rfind('\n', text.size() - 2) + 1));
    std::string field;
    for (int i = 0; i <= column; ++i) std::getline(row, field, ',');
    return std::stod(field);
  }

  std::string write(const std::string& name, const std::string& text) {
    support::write_file(folder_.path() + "/" + name, text);
    return folder_.path() + "/" + name;
  }

  /// A mass on a rail, pushed by an input; 2 kg.
  std::string slider() {
    return write(
        "slider.toml",
        "[model]\nname = \"slider\"\n[parameters]\nmass = { value = 2.0, unit = \"kg\" }\n"
        "[[body]]\nname = \"block\"\nmass = \"mass\"\n[[joint]]\nname = \"rail\"\ntype = \"prismatic\"\n"
        "parent = \"world\"\nchild = \"block\"\naxis = [1, 0, 0]\n"
        "[[actuator]]\nname = \"push\"\njoint = \"rail\"\n");
  }

  std::string csv() const { return folder_.path() + "/run.csv"; }

  support::TemporaryFolder folder_;
};

TEST_F(DrivenRuns, InputsFromATableChangeLinearly) {
  const std::string table = write("u.csv", "time,push\n0,0\n1,6\n");
  expect(simulate(slider(), {"--inputs", table, "--duration", "2", "--step", "0.01"}), 0,
         "inputs from a table");
  // a = 3 t up to 1 s, then 3: v(2) = 4.5, x(2) = 0.5 + 1.5 + 1.5.
  EXPECT_NEAR(last(1), 3.5, 1e-12);
  EXPECT_NEAR(last(2), 4.5, 1e-12);
}

TEST_F(DrivenRuns, InputsMayBeExpressions) {
  const std::string inputs = write("u.toml", "[input]\npush = \"2*mass*cos(t)\"\n");
  expect(simulate(slider(), {"--inputs", inputs, "--duration", "1", "--step", "0.01", "--set", "mass=5"}), 0,
         "inputs as functions of time");
  EXPECT_NEAR(last(1), 2 * (1 - std::cos(1.0)), 1e-9);
}

TEST_F(DrivenRuns, MotionsAreFollowed) {
  const std::string motion = write("m.toml", "[follow]\nrail = \"0.3 + 0.1*sin(2*t)\"\n");
  expect(simulate(slider(), {"--inputs", motion, "--duration", "1", "--step", "0.01"}), 0,
         "following a motion");
  EXPECT_NEAR(last(1), 0.3 + 0.1 * std::sin(2.0), 1e-10);
}

TEST_F(DrivenRuns, ParametersAreSet) {
  expect(
      simulate(slider(), {"--constant-input", "6", "--set", "mass=3", "--duration", "1", "--step", "0.01"}),
      0, "constant inputs");
  EXPECT_NEAR(last(1), 1, 1e-12);
  const std::string block = std::string(JOURDAIN_SOURCE_DIR) + "/models/block_on_slope.toml";
  expect(simulate(block, {"--set", "friction=-1", "--duration", "1", "--step", "0.01"}), 2, "is negative\n");
  expect(simulate(slider(), {"--set", "mas=3"}), 2, "did you mean 'mass'?");
  expect(simulate(slider(), {"--set", "mass=heavy"}), 2, "a number must follow");
  expect(simulate(slider(), {"--set", "mass"}), 2, "a number must follow");
}

TEST_F(DrivenRuns, MethodsAreChosenByName) {
  expect(
      simulate(slider(), {"--method", "euler", "--constant-input", "2", "--duration", "1", "--step", "0.25"}),
      0, "with euler in double");
  EXPECT_NEAR(last(1), 0.375, 1e-15);  // 0.25² (0 + 1 + 2 + 3)
  expect(simulate(slider(), {"--method", "heum"}), 2, "did you mean 'heun'?");
}

TEST_F(DrivenRuns, PlotsShowTheCoordinates) {
  const std::string plot = folder_.path() + "/p.svg";
  expect(simulate(slider(), {"--plot", plot, "--duration", "1"}), 0, plot);
  const std::string text = support::read_file(plot);
  EXPECT_EQ(text.substr(0, 4), "<svg");
  EXPECT_NE(text.find("rail"), std::string::npos);
}

TEST_F(DrivenRuns, TablesMayBeThoseOfSpreadsheets) {
  const std::string inputs = write("u.csv", "\xEF\xBB\xBFtime,push\r\n0,4\r\n1,4\r\n");
  expect(simulate(slider(), {"--inputs", inputs, "--duration", "1", "--step", "0.01"}), 0,
         "inputs from a table");
  EXPECT_NEAR(last(1), 1, 1e-12);
}

TEST_F(DrivenRuns, WrongTablesAreDiagnosed) {
  const auto message = [&](const std::string& text, const std::string& part) {
    expect(simulate(slider(), {"--inputs", write("u.csv", text)}), 1, part);
  };
  message("t,push\n0,0\n", "u.csv:1:1: error: the first column is 't', not 'time'");
  message("time,pusch\n0,0\n", "did you mean 'push'?");
  message("time,push\n0,0\n1,x\n", "u.csv:3:3: error: 'x' is not a finite number");
  message("time,push\n0,0\n0,1\n", "u.csv:3:1: error: time 0 does not come after 0");
  message("time,push,push\n0,1,2\n", "u.csv:1:11: error: input 'push' has a column already");
  message("time,push\n0\n", "1 values for 2 columns");
  message("time,push\n", "no rows");
  message("", "no rows");
}

TEST_F(DrivenRuns, WrongScenariosAreDiagnosed) {
  const auto message = [&](const std::string& text, const std::string& part) {
    expect(simulate(slider(), {"--inputs", write("s.toml", text)}), 1, part);
  };
  message("[input]\npusch = 1\n", "did you mean 'push'");
  message("[input]\npush = \"2*x\"\n", "s.toml:2:");
  message("[follow]\n", "every coordinate needs a motion");
  message("", "must have [input] or [follow]");
  message("[input]\n[follow]\nrail = 1\n", "not both");
  message("[input\n", "TOML syntax");
  for (const char* motion :
       {"max(0, t - 0.5)", "abs(t - 1)", "0.3*floor(2*t)", "mod(t, 0.5)", "min(t, 1)^2", "if(t > 1, 1, 0)",
        "sign(t - 1)", "sqrt((t - 1)^2)", "asin(sin(t))", "0.1*tan(t)"})
    message(fmt::format("[follow]\nrail = \"{}\"\n", motion),
            "s.toml:2:8: error: 'rail' of [follow] may have a kink");
  expect(simulate("models/crane.toml", {"--inputs", write("s.toml", "[follow]\na = 1\n")}), 1, "quaternions");
  expect(simulate("models/double_pendulum.toml", {"--inputs", write("s.toml", "[follow]\nx = 1\n")}), 1,
         "error");
}

}  // namespace
}  // namespace jourdain::tests
