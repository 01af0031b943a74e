// `jourdain bench`: what is counted agrees with the manifest and repeats, what is measured is in order; no time is
// asserted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands/callgrind.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFunctions = "mass_matrix,forward_dynamics,close_loops,rk4_step,adams_bashforth2_step";

/// Runs a short `jourdain bench` from the project's root.
support::ProcessResult bench(const std::vector<std::string>& arguments, const std::string& path = "") {
  std::vector<std::string> command = {"env", "-C", JOURDAIN_SOURCE_DIR};
  if (!path.empty()) command.push_back(fmt::format("PATH={}:{}", path, std::getenv("PATH")));
  for (const char* word : {JOURDAIN_BINARY, "bench", "--blocks", "3", "--states", "2"})
    command.emplace_back(word);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

json bench_of(const std::string& model, std::vector<std::string> more = {}, const std::string& path = "") {
  more.insert(more.begin(), {model, "--json"});
  const support::ProcessResult result = bench(more, path);
  EXPECT_EQ(result.status, 0) << result.output;
  return json::parse(result.output.substr(result.output.find('{')));  // behind notes on loops
}

const json& entry_of(const json& list, const std::string& name) {
  for (const json& entry : list)
    if (entry["name"] == name) return entry;
  ADD_FAILURE() << "no " << name;
  return list.front();
}

json exact_part(json bench) {
  for (json& function : bench["functions"]) function.erase("measured");
  return bench;
}

/// A program of that name in the folder.
void write_program(const fs::path& file, const std::string& script) {
  support::write_file(file.string(), "#!/bin/sh\n" + script + "\n");
  fs::permissions(file, fs::perms::owner_all);
}

TEST(Bench, OperationsAreTheManifests) {
  const support::TemporaryFolder folder;
  const json bench = bench_of("models/four_bar.toml", {"--functions", kFunctions});
  const support::ProcessResult compiled =
      support::run_process({"env", "-C", JOURDAIN_SOURCE_DIR, JOURDAIN_BINARY, "compile",
                            "models/four_bar.toml", "--functions", kFunctions, "-o", folder.path()});
  ASSERT_EQ(compiled.status, 0) << compiled.output;
  const json manifest = json::parse(support::read_file(folder.path() + "/four_bar.json"));
  for (const char* name : {"mass_matrix", "forward_dynamics", "close_loops"}) {
    const json& function = entry_of(bench["functions"], name);
    const json& counted = manifest["operations"][name];
    EXPECT_EQ(function["operations"], counted["arithmetic"]) << name;
    EXPECT_EQ(function["sin_and_cos"], counted["sin"].get<long>() + counted["cos"].get<long>()) << name;
  }
  for (const char* name : {"rk4_step", "adams_bashforth2_step"})
    EXPECT_EQ(entry_of(bench["functions"], name)["operations"], manifest["steps"][name]["operations"]);
}

TEST(Bench, CountsRepeatAndTimesAreInOrder) {
  const std::vector<std::string> options = {"--functions", kFunctions, "--real", "float"};
  const json once = bench_of("models/double_pendulum.toml", options);
  EXPECT_EQ(exact_part(once), exact_part(bench_of("models/double_pendulum.toml", options)));
  EXPECT_EQ(once["number_type"], "float");
  EXPECT_EQ(once["functions"].size(), 4u);
  for (const json& function : once["functions"]) {
    EXPECT_EQ(function["finite_states"], 2) << function;
    EXPECT_GT(function["code_bytes"], 0) << function;
    EXPECT_GT(function["measured"]["least_s"], 0) << function;
    EXPECT_LE(function["measured"]["least_s"], function["measured"]["median_s"]) << function;
    if (function["instructions"].is_null()) continue;  // no valgrind
    EXPECT_LE(function["instructions"]["least"], function["instructions"]["mean"]) << function;
    EXPECT_LE(function["instructions"]["mean"], function["instructions"]["most"]) << function;
  }
  const json &dynamics = entry_of(once["functions"], "forward_dynamics"),
             &step = entry_of(once["functions"], "rk4_step");
  EXPECT_GE(step["code_bytes"], dynamics["code_bytes"]);
  if (dynamics["instructions"].is_null()) return;
  EXPECT_GT(dynamics["instructions"]["least"], dynamics["operations"]);
  EXPECT_GT(step["instructions"]["least"], 4 * dynamics["operations"].get<long>());
}

TEST(Bench, CodeIsWhatTheGraphOfCallsSays) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/cost.json";
  const support::ProcessResult cost = support::run_process(
      {"env", "-C", JOURDAIN_SOURCE_DIR, "CXX=g++", JOURDAIN_BINARY, "cost", "models/spring_pendulum.toml",
       "--methods", "rk4,heun", "--warm", "10", "--cold", "1", "-o", file});
  ASSERT_EQ(cost.status, 0) << cost.output;
  const json costs = json::parse(support::read_file(file));
  const json bench = bench_of("models/spring_pendulum.toml",
                              {"--compiler", "g++", "--functions", "inverse_dynamics,rk4_step,heun_step"});
  EXPECT_EQ(entry_of(bench["functions"], "inverse_dynamics")["code_bytes"],
            entry_of(costs["functions"], "inverse_dynamics")["code_bytes"]);
  for (const char* step : {"rk4_step", "heun_step"})
    EXPECT_EQ(entry_of(bench["functions"], step)["code_bytes"], entry_of(costs["steps"], step)["code_bytes"]);
}

TEST(Bench, EverySceneHasStatesAndFiniteNumbers) {
  // Quaternions and inputs; loops held by multipliers. A loop with a closed form is above.
  for (const char* model : {"quadrotor", "n_four_bar"}) {
    const json bench =
        bench_of(fmt::format("models/{}.toml", model), {"--functions", "forward_dynamics", "--seed", "7"});
    EXPECT_EQ(bench["seed"], 7);
    for (const json& function : bench["functions"]) EXPECT_EQ(function["finite_states"], 2) << function;
  }
}

TEST(Bench, SaysWhyInstructionsAreNotCounted) {
  const support::TemporaryFolder folder;
  write_program(folder.path() + "/valgrind", "exit 1");
  json bench = bench_of("models/pendulum.toml", {"--functions", "q_bar"}, folder.path());
  EXPECT_EQ(bench["instructions_by"], "valgrind is not installed: instructions are not counted");
  EXPECT_TRUE(bench["functions"][0]["instructions"].is_null());
  write_program(folder.path() + "/valgrind", "[ \"$1\" = --version ] && echo valgrind-9");
  bench = bench_of("models/pendulum.toml", {"--functions", "q_bar"}, folder.path());
  EXPECT_EQ(bench["instructions_by"], "valgrind-9 cannot run this code: instructions are not counted");
}

TEST(Bench, NamesMachineCompilerAndOptions) {
  const support::ProcessResult result =
      bench({"models/pendulum.toml", "--compiler", "clang++", "--flags", "-O1 -fno-math-errno"});
  ASSERT_EQ(result.status, 0) << result.output;
  for (const char* part : {"pendulum in double", "clang version", "-O1 -fno-math-errno", "forward_dynamics",
                           "forward_dynamics_derivatives", "rk4_step", "2 states are drawn from seed 1"})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << " is missing in\n" << result.output;
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 125u) << line;
}

TEST(Bench, MistakesEndWithTheirStatus) {
  const support::TemporaryFolder folder;
  const std::string bad = folder.path() + "/bad.toml";
  support::write_file(bad, "[model]\nname = \"bad\"\n[[joint]]\nname = \"j\"\ntype = \"revolute\"\n");
  const auto expect = [&](const std::vector<std::string>& arguments, int status, const std::string& part) {
    const support::ProcessResult result = bench(arguments);
    EXPECT_EQ(result.status, status) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  };
  const std::string model = "models/pendulum.toml";
  expect({bad}, 1, "bad.toml:3");
  expect({"models/nothing.toml"}, 3, "models/nothing.toml");
  expect({model, "--functions", "massmatrix"}, 2, "did you mean 'mass_matrix'");
  expect({model, "--functions", ""}, 2, "no function ''");
  expect({model, "--real", "long"}, 2, "--real");
  expect({model, "--states", "0"}, 2, "--states");
  expect({model, "--compiler", " "}, 2, "--compiler is empty");
  expect({model, "--compiler", "no-such-compiler"}, 3, "cannot run 'no-such-compiler'");
  expect({model, "--flags", "-fno-such-option"}, 3, "-fno-such-option");
}

TEST(Callgrind, AddsNothingAndMixesNoNames) {
  const std::vector<commands::CountedCalls> calls = commands::read_callgrind(
      "events: Ir\nfl=(1) a.cpp\nfn=(1) main\n10 5\ncfi=(2) b.cpp\ncfn=(2) step(double)\ncalls=3 20\n11 300\n"
      "cfn=(3) sin\ncalls=1 0\n* 40\n\nfn=(2)\n21 100\ncfn=(3)\ncalls=6 0\n+2 160\n\ntotals: 305\n");
  ASSERT_EQ(calls.size(), 3u);
  const auto expect = [](const commands::CountedCalls& c, const char* caller, const char* callee,
                         long long count, long long instructions) {
    EXPECT_EQ(c.caller, caller);
    EXPECT_EQ(c.callee, callee);
    EXPECT_EQ(c.calls, count);
    EXPECT_EQ(c.instructions, instructions);
  };
  expect(calls[0], "main", "step(double)", 3, 300);
  expect(calls[1], "main", "sin", 1, 40);
  expect(calls[2], "step(double)", "sin", 6, 160);
}

}  // namespace
}  // namespace jourdain::tests
