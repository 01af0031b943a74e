// Independent velocities on the command line: what steps they have, and other parameters than those of the description.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

constexpr const char* kRobot = "models/differential_drive.toml";

class IndependentVelocitiesOnTheCommandLine : public testing::Test {
 protected:
  /// The command on the robot, with what it writes into a folder of the test.
  support::ProcessResult run(const std::string& command, std::vector<std::string> options) {
    options.insert(options.begin(), {command, kRobot});
    return jourdain(options);
  }

  const support::TemporaryFolder folder_;
  const std::string csv_ = folder_.path() + "/run.csv", out_ = folder_.path() + "/out";
};

TEST_F(IndependentVelocitiesOnTheCommandLine, StepsThatNeedAllDerivativesNeedMultipliers) {
  const std::string why = "rodas4 needs the derivatives of velocities that follow from others";
  expect(run("simulate", {"--method", "rodas4", "--output", csv_}), 2, why);
  expect(run("compile", {"--functions", "rodas4_step", "-o", out_}), 2, why);
  expect(run("cost", {"--methods", "rk4,rodas4"}), 2, why);
  expect(run("report", {"--methods", "rk4,rodas4", "-o", out_}), 2, why);
}

TEST_F(IndependentVelocitiesOnTheCommandLine, WMethodsDoWithoutSome) {
  expect(
      run("compile", {"--functions", "ros34pw2_step,rosw43_step,linearly_implicit_euler_step", "-o", out_}),
      0, "3 steps as defined");
  expect(run("simulate", {"--method", "rosw43", "--output", csv_, "--constant-input", "0.2,0.3"}), 0, "");
}

TEST_F(IndependentVelocitiesOnTheCommandLine, AreProvenAgainAtOtherParameters) {
  std::string text = support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/" + kRobot);
  for (const std::string range : {", range = [0.05, 0.2]", ", range = [0.2, 0.8]"}) {
    ASSERT_NE(text.find(range), std::string::npos);
    text.erase(text.find(range), range.size());
  }
  const std::string robot = folder_.path() + "/robot.toml";
  support::write_file(robot, text);
  const std::vector<std::string> driven = {"simulate",   robot, "--output",         csv_,
                                           "--duration", "0.1", "--constant-input", "0.2,0.3"};
  const auto with = [&](const char* setting) {
    std::vector<std::string> options = driven;
    options.insert(options.end(), {"--set", setting});
    return jourdain(options);
  };
  expect(with("radius=0.2"), 0, "at t = 0.1 s");
  expect(with("track=0.3"), 0, "at t = 0.1 s");
  expect(with("track=0"), 2, "not proven to close at track = 0: velocities of floor_x");
}

}  // namespace
}  // namespace jourdain::tests
