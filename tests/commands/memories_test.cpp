// Memories on the command line: where they are stepped, and where they are refused.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "commands/run_jourdain.hpp"
#include "support/csv.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

constexpr const char* kServo = "models/digital_servo.toml";

class MemoriesOnTheCommandLine : public testing::Test {
 protected:
  /// The command on the servo, with what it writes into a folder of the test.
  support::ProcessResult run(const std::string& command, std::vector<std::string> options) {
    options.insert(options.begin(), {command, kServo});
    return jourdain(options);
  }

  const support::TemporaryFolder folder_;
  const std::string csv_ = folder_.path() + "/run.csv", out_ = folder_.path() + "/out";
};

TEST_F(MemoriesOnTheCommandLine, StepsDivideThePeriod) {
  expect(run("simulate", {"--output", csv_, "--step", "1e-3", "--duration", "0.1"}), 0, "last_reading_timer");
  EXPECT_NE(support::read_file(csv_).find("torque"), std::string::npos);
  for (const char* step : {"1.3e-3", "0.01", "0.00500001"})
    expect(run("simulate", {"--output", csv_, "--step", step, "--duration", "0.1"}), 2,
           "last_reading_timer has a period of 0.005 s");
  expect(
      run("simulate", {"--output", csv_, "--step", "1e-3", "--duration", "0.1", "--set", "sampling=2.5e-3"}),
      2, "2.5 steps of 0.001 s");
  expect(run("simulate", {"--output", csv_, "--step", "1e-3", "--duration", "0.1", "--set", "sampling=-1"}),
         2, "'period' of memory 'last_reading' is negative");
  expect(run("simulate", {"--output", csv_, "--step", "1e-3", "--duration", "0.1", "--set", "sampling=0"}), 2,
         "state 'integral' has no finite value at the initial state");  // whose gain is divided by it
  expect(
      run("simulate", {"--output", csv_, "--step", "1e-3", "--duration", "0.1", "--set", "sampling=0.003"}),
      0, "at t = 0.1 s");
}

TEST_F(MemoriesOnTheCommandLine, AreSteppedInEnsembles) {
  expect(run("ensemble", {"--states", "20", "--duration", "0.1", "--spread", "target_input=normal(0.01)"}), 0,
         "torque_1");
  expect(run("ensemble", {"--states", "20", "--duration", "0.1", "--step", "2e-3"}), 2,
         "2.5 steps of 0.002 s");
  expect(run("ensemble", {"--states", "20", "--duration", "0.1", "--spread", "sampling=normal(1%)"}), 2,
         "the period of last_reading_timer follows from 'sampling'");
}

/// At the ends of whole periods runs agree that take the same samples.
TEST_F(MemoriesOnTheCommandLine, ShorterStepsTakeTheSameSamples) {
  const auto after = [&](const char* step) {
    const std::string output = run("simulate", {"--output", "-", "--step", step, "--duration", "0.25",
                                                "--every", "1", "--constant-input", "0.2"})
                                   .output;
    const std::size_t row = output.rfind('\n', output.size() - 2) + 1;
    return std::stod(output.substr(output.find(',', row) + 1));
  };
  const double coarse = after("5e-3"), fine = after("1e-3"), finer = after("5e-4");
  EXPECT_NEAR(fine, finer, 1e-11);
  EXPECT_NEAR(coarse, fine, 1e-7);
}

TEST_F(MemoriesOnTheCommandLine, MethodsOfSeveralStepsAreRefused) {
  const std::string why = "adams_bashforth2 goes on with rates of earlier steps";
  expect(run("simulate", {"--method", "adams_bashforth2", "--output", csv_}), 2, why);
  expect(run("compile", {"--functions", "adams_bashforth2_step", "-o", out_}), 2, why);
  expect(run("wrap", {"--for", "simulink", "--method", "adams_bashforth2", "-o", out_}), 2, why);
  expect(run("cost", {"--methods", "rk4,adams_bashforth2"}), 2, why);
}

TEST_F(MemoriesOnTheCommandLine, WhatFollowsRatesAloneIsRefused) {
  expect(run("report", {"-o", out_}), 2, "has memories; the solutions that a report compares with");
  expect(run("fmu", {"-o", out_ + ".fmu"}), 2, "has memories; units with events");
  expect(run("wrap", {"--for", "casadi", "-o", out_}), 2, "casadi is not given rates of memories");
}

TEST_F(MemoriesOnTheCommandLine, AreSteppedInCAndPython) {
  expect(run("wrap", {"--for", "simulink", "-o", out_}), 0, "_sfunction.c");
  expect(run("compile", {"--language", "c", "--interface", "-o", out_}), 0, "2 steps as defined");
  EXPECT_NE(support::read_file(out_ + "/digital_servo.h").find("digital_servo_sample("), std::string::npos);
  expect(run("python", {"-o", out_}), 0, "5 steps as defined");
  EXPECT_EQ(support::read_file(out_ + "/digital_servo.py").find("adams_bashforth2_step("), std::string::npos);
}

/// What is named stands behind the one that names it; each is looked at alone.
TEST_F(MemoriesOnTheCommandLine, AndStatesHaveAValueAtTheStart) {
  const auto check = [&](const std::string& more) {
    const std::string file = folder_.path() + "/scene.toml";
    support::write_file(file, R"toml([model]
name = "scene"
[[body]]
name = "bob"
mass = 1
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "bob"
[[state]]
name = "first"
rate = "third + held"
)toml" + more);
    return jourdain({"check", file});
  };
  const std::string held = "[[memory]]\nname = \"held\"\nperiod = 0.01\nupdate = ",
                    third = "[[state]]\nname = \"third\"\nrate = ";
  expect(check(held + "\"slide + third\"\n" + third + "\"held\"\n"), 0, "ok: scene");
  expect(check(held + "\"third/slide\"\n" + third + "\"held\"\n"), 1,
         ":15:8: error: state 'held' has no finite value at the initial state");
  expect(check(held + "\"third\"\n" + third + "\"1/(slide + held)\"\n"), 1,
         ":19:8: error: state 'third' has no finite value at the initial state");
}

TEST_F(MemoriesOnTheCommandLine, PeriodsThatAreSetToZeroSampleAtEveryStep) {
  const std::string file = folder_.path() + "/counter.toml";
  support::write_file(file, R"toml([model]
name = "counter"
[parameters]
sampling = { value = 0.01, unit = "s" }
[[body]]
name = "bob"
mass = 1
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "bob"
[[memory]]
name = "count"
update = "count + 1"
period = "sampling"
[[force]]
joint = "slide"
value = "count"
)toml");
  const std::vector<std::string> command = {"simulate", file, "--output", csv_, "--duration", "0.1", "--set"};
  const auto set = [&](const char* sampling) {
    std::vector<std::string> words = command;
    words.emplace_back(sampling);
    return jourdain(words);
  };
  expect(set("sampling=0"), 0, "at t = 0.1 s");
  const std::string rows = support::read_file(csv_);
  EXPECT_NE(rows.substr(rows.rfind('\n', rows.size() - 2)).find(",100,"), std::string::npos) << rows;
  expect(set("sampling=0.02"), 0, "at t = 0.1 s");
}

/// The first sample is part of the first step, however long the period is.
TEST_F(MemoriesOnTheCommandLine, BeginWithWhatTheDescriptionSays) {
  const std::string file = folder_.path() + "/counters.toml";
  support::write_file(file, R"toml([model]
name = "counters"
[[body]]
name = "bob"
mass = 1
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "bob"
axis = [1, 0, 0]
initial_velocity = 1
[[memory]]
name = "each_step"
update = "each_step + 1"
period = 0
initial = 7
[[memory]]
name = "each_second"
update = "each_second + 1"
period = 1
initial = 7
[[memory]]
name = "late"
update = "100 + 10*slide"
delay = 2
period = 0
initial = 7
[[force]]
joint = "slide"
value = "0*(each_step + each_second + late)"
[[output]]
name = "counts"
kind = "expression"
value = "1e6*each_step + 1e3*each_second + late"
)toml");
  const support::ProcessResult result = jourdain({"simulate", file, "--step", "1", "--duration", "4",
                                                  "--every", "1", "--output", "-", "--outputs", "counts"});
  ASSERT_EQ(result.status, 0) << result.output;
  std::vector<double> counts;
  for (const support::CsvRow& row : support::csv_rows(result.output)) {
    const std::optional<double> count = support::number_in(row.fields.back());
    if (count) counts.push_back(*count);
  }
  EXPECT_EQ(counts, (std::vector<double>{7007007, 8008007, 9009007, 10010100, 11011110}));
}

TEST_F(MemoriesOnTheCommandLine, TheHeaderSaysWhatIsSampled) {
  expect(run("compile", {"-o", out_}), 0, "sample");
  const std::string header = support::read_file(out_ + "/digital_servo.hpp");
  EXPECT_NE(
      header.find("Steps begin with samples of last_reading (rad), last_reading_timer (s), integral (N m), "),
      std::string::npos);
}

}  // namespace
}  // namespace jourdain::tests
