// `jourdain cost`: what is exact agrees with the manifest and the compiler and repeats; what is measured is in order.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kMethods = "rk4,adams_bashforth3,rosw43";

/// Runs `jourdain` from the project's root.
support::ProcessResult jourdain(std::vector<std::string> arguments,
                                std::vector<std::string> environment = {}) {
  std::vector<std::string> command = {"env", "-C", JOURDAIN_SOURCE_DIR};
  command.insert(command.end(), environment.begin(), environment.end());
  command.push_back(JOURDAIN_BINARY);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

/// The JSON of a short run.
json cost_of(const std::string& model, const std::string& real = "double",
             const std::vector<std::string>& environment = {}, const std::vector<std::string>& more = {}) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/cost.json";
  std::vector<std::string> arguments = {"cost",   model,  "--real", real, "--methods", kMethods,
                                        "--warm", "2000", "--cold", "3",  "-o",        file};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const support::ProcessResult result = jourdain(arguments, environment);
  EXPECT_EQ(result.status, 0) << result.output;
  return json::parse(support::read_file(file));
}

const json& entry_of(const json& list, const std::string& name) {
  for (const json& entry : list)
    if (entry["name"] == name) return entry;
  ADD_FAILURE() << "no " << name;
  return list.front();
}

/// As `compile --functions` takes them, so that the same files are compiled.
std::string functions_of(const json& cost) {
  std::string functions;
  for (const char* list : {"functions", "steps"})
    for (const json& entry : cost[list])
      if (entry["name"] != "model") functions += entry["name"].get<std::string>() + ",";
  functions.pop_back();
  return functions;
}

/// What does not depend on time.
json exact_part(json cost) {
  for (json& step : cost["steps"]) step.erase("measured");
  for (const char* key : {"remarks", "clock_tick_s"}) cost.erase(key);
  return cost;
}

void expect_ordered(const json& quantiles, long steps) {
  EXPECT_EQ(quantiles["steps"], steps);
  EXPECT_GT(quantiles["median_s"].get<double>(), 0);
  EXPECT_LE(quantiles["median_s"], quantiles["99_percent_s"]);
  EXPECT_LE(quantiles["99_percent_s"], quantiles["99.9_percent_s"]);
  EXPECT_LE(quantiles["99.9_percent_s"], quantiles["worst_s"]);
}

TEST(Cost, OperationsAreTheManifests) {
  const support::TemporaryFolder folder;
  for (const char* name : {"double_pendulum", "tumbling_body", "n_four_bar"}) {
    const std::string model = fmt::format("models/{}.toml", name);
    const json cost = cost_of(model);
    ASSERT_EQ(jourdain({"compile", model, "--functions", functions_of(cost), "-o", folder.path()}).status, 0);
    const json manifest = json::parse(support::read_file(fmt::format("{}/{}.json", folder.path(), name)));
    EXPECT_EQ(cost["functions"].size(), manifest["operations"].size()) << name;
    for (const json& entry : cost["functions"])
      for (const auto& [kind, count] : manifest["operations"][entry["name"]].items())
        EXPECT_EQ(entry["operations"][kind], count) << name << " " << entry["name"] << " " << kind;
    EXPECT_EQ(cost["steps"].size(), manifest["steps"].size()) << name;
    for (const json& step : cost["steps"])
      EXPECT_EQ(step["operations"], manifest["steps"][step["name"]]["operations"]) << name;
  }
}

TEST(Cost, WhatIsExactRepeats) {
  for (const char* real : {"double", "float"}) {
    const json once = cost_of("models/double_pendulum.toml", real);
    EXPECT_EQ(exact_part(once), exact_part(cost_of("models/double_pendulum.toml", real)));
    for (const char* list : {"functions", "steps"})
      for (const json& entry : once[list]) {
        EXPECT_GT(entry["stack_bytes"].get<long>(), 0) << entry["name"];
        EXPECT_GT(entry["code_bytes"].get<long>(), 0) << entry["name"];
      }
    EXPECT_EQ(once["number_type"], real);
  }
}

/// Own bytes of stack of the instance in double whose signature holds `function`, by -fstack-usage.
long own_stack(const std::string& usage, const std::string& function) {
  std::istringstream lines(usage);
  for (std::string line; std::getline(lines, line);) {
    const bool found = line.find("::" + function + "(") != std::string::npos &&
                       line.find("Real = double]\t") != std::string::npos;
    if (found) return std::atol(line.c_str() + line.find("]\t") + 2);
  }
  ADD_FAILURE() << "no " << function;
  return 0;
}

/// Bytes of a function's code in double, from a listing of `nm -S -C`.
long own_code(const std::string& listing, const std::string& function) {
  std::istringstream lines(listing);
  for (std::string line; std::getline(lines, line);)
    if (line.find("::" + function + "<double>(") != std::string::npos)
      return std::strtol(line.c_str() + line.find(' '), nullptr, 16);
  ADD_FAILURE() << "no " << function;
  return 0;
}

TEST(Cost, StackAndCodeAreTheCompilers) {
  const support::TemporaryFolder folder;
  // The dynamics call nothing of the model's then, and steps call them.
  const json cost =
      cost_of("models/double_pendulum.toml", "double", {"CXX=c++ -DJOURDAIN_INLINED="}, {"--libm"});
  ASSERT_EQ(jourdain({"compile", "models/double_pendulum.toml", "--libm", "--functions", functions_of(cost),
                      "-o", folder.path()})
                .status,
            0);
  const support::ProcessResult compiled =
      support::run_process({"env", "-C", folder.path(), "c++", "-std=c++17", "-O2",
                            "-DJOURDAIN_INLINED=", "-fstack-usage", "-c", "double_pendulum.cpp"});
  ASSERT_EQ(compiled.status, 0) << compiled.output;
  const std::string usage = support::read_file(folder.path() + "/double_pendulum.su");
  const std::string listing =
      support::run_process({"nm", "-S", "-C", folder.path() + "/double_pendulum.o"}).output;
  const json& dynamics = entry_of(cost["functions"], "forward_dynamics");
  EXPECT_EQ(dynamics["stack_bytes"], own_stack(usage, "forward_dynamics"));
  EXPECT_EQ(dynamics["code_bytes"], own_code(listing, "forward_dynamics"));
  // A step calls the dynamics, whose frame and code are part of what it needs.
  const json& step = entry_of(cost["steps"], "rk4_step");
  EXPECT_EQ(step["stack_bytes"], own_stack(usage, "rk4_step") + own_stack(usage, "forward_dynamics"));
  EXPECT_GE(step["code_bytes"], own_code(listing, "rk4_step") + own_code(listing, "forward_dynamics"));
}

TEST(Cost, WithoutAGraphOfCallsStackAndCodeAreNotKnown) {
  for (const char* compiler : {"CXX=clang++", "CXX=g++ -flto"}) {
    const json cost = cost_of("models/pendulum.toml", "double", {compiler});
    for (const json& entry : cost["functions"]) EXPECT_TRUE(entry["stack_bytes"].is_null());
    EXPECT_NE(cost["remarks"][1].get<std::string>().find("set CXX=g++"), std::string::npos);
  }
}

TEST(Cost, WhatIsMeasuredIsInOrder) {
  for (const char* model : {"models/double_pendulum.toml", "models/four_bar.toml"}) {
    const json cost = cost_of(model);
    ASSERT_EQ(cost["steps"].size(), 3u);
    EXPECT_GT(cost["clock_tick_s"].get<double>(), 0);
    EXPECT_EQ(cost["faint_velocity"], 1e-160);
    for (const json& step : cost["steps"]) {
      const json& measured = step["measured"];
      expect_ordered(measured["warm"], 2000);
      expect_ordered(measured["cold"], 3);
      for (const char* ratio : {"subnormal_ratio", "angle_1e3_ratio", "angle_1e6_ratio"})
        EXPECT_GT(measured[ratio].get<double>(), 0) << ratio;
#ifdef __SSE2__
      EXPECT_GT(measured["subnormal_flushed_ratio"].get<double>(), 0);
#endif
    }
  }
}

TEST(Cost, WithoutAnglesThereIsNoRatioOfLargeOnes) {
  const json cost = cost_of("models/tumbling_body.toml");
  for (const json& step : cost["steps"]) EXPECT_TRUE(step["measured"]["angle_1e3_ratio"].is_null());
}

TEST(Cost, SaysInSentencesWhatTheNumbersMean) {
  const support::ProcessResult result =
      jourdain({"cost", "models/pendulum.toml", "--methods", "rk4", "--warm", "1000", "--cold", "2"});
  ASSERT_EQ(result.status, 0) << result.output;
  for (const char* part :
       {"forward_dynamics", "rk4_step", "in 4 evaluations", "does the same 30 arithmetic", "bytes of stack",
        "99.9 % of 1000 warm rk4 steps", "it is no bound", "subnormal", "FTZ and DAZ", "1e6 rad"})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << " is missing in\n" << result.output;
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 112u) << line;
}

TEST(Cost, SaysWhereStepsDiverge) {
  const auto told = [](const std::string& step) {
    const support::ProcessResult result = jourdain({"cost", "models/flyball_governor.toml", "--methods",
                                                    "rk4", "--warm", "1000", "--cold", "1", "--step", step});
    EXPECT_EQ(result.status, 0) << result.output;
    return result.output.find("steps of this length diverged") != std::string::npos;
  };
  EXPECT_TRUE(told("1e-3"));
  EXPECT_FALSE(told("1e-5"));
}

TEST(Cost, SaysWhatIsNotCountedOfAnglesOfTime) {
  for (const auto& [model, counted] : {std::pair("pendulum", true), {"crane", false}}) {
    const support::ProcessResult result = jourdain(
        {"cost", fmt::format("models/{}.toml", model), "--methods", "rk4", "--warm", "200", "--cold", "1"});
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_EQ(result.output.find("of what follows from time") == std::string::npos, counted) << model;
  }
}

TEST(Cost, TakesWhatMovesAsPrescribedAlone) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/turntable.toml";
  support::write_file(file,
                      "[model]\nname = \"turntable\"\n[[body]]\nname = \"disc\"\nmass = 1\n"
                      "center_of_mass = [0.1, 0, 0]\n[[joint]]\nname = \"j\"\ntype = \"revolute\"\n"
                      "parent = \"world\"\nchild = \"disc\"\naxis = [0, 0, 1]\nmotion = \"sin(3*t)\"\n"
                      "[[output]]\nname = \"drive\"\nkind = \"drive\"\njoint = \"j\"\n");
  const json cost = cost_of(file, "double", {}, {"--methods", "rk4"});
  EXPECT_GT(entry_of(cost["steps"], "rk4_step")["operations"], 0);
}

TEST(Progress, ShowsOnATerminalFromTheFirstWordOn) {
  // Deriving the pendulum takes no time, and nothing is said after it before the next part begins.
  const std::string command = fmt::format("{} cost {}/models/pendulum.toml --methods rk4 --warm 100 --cold 1",
                                          JOURDAIN_BINARY, JOURDAIN_SOURCE_DIR);
  const support::ProcessResult terminal = support::run_process({"script", "-qec", command, "/dev/null"});
  EXPECT_EQ(terminal.status, 0) << terminal.output;
  EXPECT_NE(terminal.output.find("0% deriving the equations"), std::string::npos) << terminal.output;
  EXPECT_EQ(jourdain({"cost", "models/pendulum.toml", "--methods", "rk4", "--warm", "100", "--cold", "1"})
                .output.find("% deriving"),
            std::string::npos);
}

TEST(Cost, MistakesEndWithTheirStatusAndWriteNothing) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/cost.json", bad = folder.path() + "/bad.toml";
  support::write_file(bad, "[model]\nname = \"bad\"\n[[joint]]\nname = \"j\"\ntype = \"revolute\"\n");
  const auto expect = [&](const std::vector<std::string>& arguments, int status, const std::string& part) {
    std::vector<std::string> all = {"cost", "-o", file};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const support::ProcessResult result = jourdain(all);
    EXPECT_EQ(result.status, status) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    EXPECT_FALSE(fs::exists(file));
  };
  expect({bad}, 1, "bad.toml:3");
  expect({"models/nothing.toml"}, 3, "models/nothing.toml");
  expect({"models/pendulum.toml", "--methods", "rk44"}, 2, "did you mean 'rk4'");
  expect({"models/pendulum.toml", "--warm", "0"}, 2, "--warm");
  expect({"models/pendulum.toml", "--set", "k=1"}, 2, "no parameter 'k'");
  const support::ProcessResult result =
      jourdain({"cost", "models/pendulum.toml", "--methods", "rk4", "-o", "/proc/nowhere/cost.json"});
  EXPECT_EQ(result.status, 3) << result.output;
}

/// What `compile` counts.
json manifest_of(const std::string& model, const std::string& functions) {
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      jourdain({"compile", "models/" + model + ".toml", "--functions", functions, "-o", folder.path()});
  EXPECT_EQ(result.status, 0) << result.output;
  return json::parse(support::read_file(folder.path() + "/" + model + ".json"));
}

std::string page(const std::string& name) {
  return support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/" + name);
}

TEST(CostPage, OperationsOfAStepAreCounted) {
  const json steps = manifest_of("ur5", "rk4_step")["steps"];
  EXPECT_NE(page("runtime/steppers.md")
                .find(fmt::format("RK4 on the UR5 in double: {}\noperations",
                                  steps["rk4_step"]["operations"].get<long>())),
            std::string::npos);
}

TEST(CostPage, OperationsOfLinearisationsAreCounted) {
  const std::string text = page("generator/operations.md");
  std::istringstream lines(text.substr(text.find("| emitted by default |")));
  std::size_t rows = 0;
  const std::regex row("\\| ([a-z0-9_]+).* \\| [0-9]+ \\| ([0-9]+) \\|");
  std::smatch parts;
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    if (!std::regex_match(line, parts, row)) continue;
    const json operations = manifest_of(parts[1], "linearize")["operations"];
    EXPECT_EQ(operations["linearize"]["arithmetic"], std::stol(parts[2])) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 5u);
}

}  // namespace
}  // namespace jourdain::tests
