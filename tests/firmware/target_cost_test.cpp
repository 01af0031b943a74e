// `jourdain cost --target`: its counts are those of listings, repeat, and stand on the page of firmware.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands/tool.hpp"
#include "firmware/firmware.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using commands::Target;
using nlohmann::json;

support::ProcessResult jourdain(std::vector<std::string> arguments,
                                const std::vector<std::string>& environment = {}) {
  std::vector<std::string> command = {"env", "-C", JOURDAIN_SOURCE_DIR};
  command.insert(command.end(), environment.begin(), environment.end());
  command.emplace_back(JOURDAIN_BINARY);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

const json& function_of(const json& cost, const std::string& name) {
  for (const json& entry : cost["functions"])
    if (entry["name"] == name) return entry;
  throw std::runtime_error("no " + name);
}

/// A model without sines, so that nothing of a library is called.
constexpr const char* kSelfContained = "tumbling_body";

/// Instructions between the entry of a function and its return, in what objdump lists of an object.
long listed_instructions(const std::string& listing, const std::string& function) {
  std::istringstream lines(listing);
  bool inside = false;
  long count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(">:")) inside = line.find(fmt::format("::{}<", function)) != std::string::npos;
    if (!inside || line.find(":\t") == std::string::npos) continue;
    EXPECT_EQ(line.find("\tbl\t"), std::string::npos) << "a call: " << line;
    ++count;
    for (const char* end : {"\tbx\tlr", "\tret", "pc}"})
      if (line.ends_with(end)) return count;
  }
  ADD_FAILURE() << "no end of " << function << " in\n" << listing;
  return 0;
}

/// Bytes of a function's code, in what `nm -S -C` lists.
long listed_code(const std::string& symbols, const std::string& function) {
  std::istringstream lines(symbols);
  for (std::string line; std::getline(lines, line);)
    if (line.find(fmt::format("::{}<", function)) != std::string::npos)
      return std::strtol(line.c_str() + line.find(' '), nullptr, 16);
  ADD_FAILURE() << "no " << function << " in\n" << symbols;
  return 0;
}

/// Bytes of a function's frame, in what -fstack-usage writes.
long listed_stack(const std::string& usage, const std::string& function) {
  std::istringstream lines(usage);
  for (std::string line; std::getline(lines, line);)
    if (line.find(fmt::format("::{}(", function)) != std::string::npos)
      return std::atol(line.c_str() + line.find('\t'));
  ADD_FAILURE() << "no " << function << " in\n" << usage;
  return 0;
}

TEST(TargetCost, StraightCodeTakesWhatListingsSay) {
  for (const Target& target : commands::all_targets()) {
    require_tools(target);
    const json cost = target_cost(kSelfContained, target);
    const std::string real = cost["number_type"], source = firmware_folder() + "/listed.cpp",
                      object = firmware_folder() + "/listed_" + target.name;
    std::string text =
        fmt::format("#include \"{0}/{1}/{1}_kernels.hpp\"\n", JOURDAIN_EMITTED, kSelfContained);
    const std::vector<std::string> functions = {"forward_dynamics", "kinetic_energy", "position_rate"};
    for (const std::string& function : functions)
      text +=
          fmt::format("template decltype({0}::{1}<{2}>) {0}::{1}<{2}>;\n", kSelfContained, function, real);
    support::write_file(source, text);
    std::vector<std::string> compile = commands::target_compiler(target);
    compile.insert(compile.end(), {"-fstack-usage", "-c", source, "-o", object + ".o"});
    commands::run_tool(compile);
    const std::string listing = commands::run_tool(
                          {target.tools + "objdump", "-dC", "--no-show-raw-insn", object + ".o"}),
                      symbols = commands::run_tool({target.tools + "nm", "-SC", object + ".o"}),
                      usage = support::read_file(object + ".su");
    for (const std::string& function : functions) {
      const json& counted = function_of(cost, function);
      EXPECT_EQ(counted["instructions"], listed_instructions(listing, function))
          << target.name << " " << function;
      EXPECT_EQ(counted["code_bytes"], listed_code(symbols, function)) << target.name << " " << function;
      EXPECT_EQ(counted["stack_bytes"], listed_stack(usage, function)) << target.name << " " << function;
    }
  }
}

TEST(TargetCost, NoMoreStackIsWrittenThanTheFramesHold) {
  for (const Target& target : commands::all_targets()) {
    require_tools(target);
    const json cost = target_cost(kSelfContained, target);
    for (const json& entry : cost["functions"]) {
      EXPECT_LE(entry["painted_stack_bytes"], entry["stack_bytes"]) << target.name << " " << entry["name"];
      EXPECT_GE(entry["instructions"], 1) << target.name << " " << entry["name"];
    }
    const json& step = function_of(cost, "rk4_step");
    // A frame may end with a few bytes that only align the next.
    EXPECT_GE(step["painted_stack_bytes"].get<long>(), step["stack_bytes"].get<long>() - 32) << target.name;
  }
}

TEST(TargetCost, IsTheSameInEveryRun) {
  for (const Target& target : commands::all_targets()) {
    require_tools(target);
    const json once = target_cost("squeezer", target);
    EXPECT_EQ(target_cost("squeezer", target, {"--methods", "rk4"}, true), once) << target.name;
  }
}

TEST(TargetCost, IsTakenWithTheParametersInputsAndNumbersAskedFor) {
  const Target& target = *commands::find_target("cortex-m4");
  require_tools(target);
  const json usual = target_cost("four_bar", target);
  EXPECT_EQ(usual["number_type"], "float");
  const json precise = target_cost("four_bar", target, {"--methods", "rk4", "--real", "double"});
  EXPECT_EQ(precise["number_type"], "double");
  EXPECT_EQ(precise["data_bytes"]["State"].get<long>(), 2 * usual["data_bytes"]["State"].get<long>());
  // Arithmetic without hardware for it.
  EXPECT_GT(function_of(precise, "rk4_step")["instructions"].get<long>(),
            10 * function_of(usual, "rk4_step")["instructions"].get<long>());
  const json all = target_cost("four_bar", target, {"--constant-input", "2.5", "--step", "1e-4"});
  EXPECT_EQ(all["step_s"], 1e-4);
  EXPECT_EQ(all["functions"].size(), usual["functions"].size() + 12) << all["functions"].dump(1);
}

/// A folder with programs of these names that say a version, and fail at all else.
std::string folder_of_fakes(const support::TemporaryFolder& folder,
                            const std::vector<std::string>& programs) {
  for (const std::string& program : programs) {
    const std::string path = folder.path() + "/" + program;
    support::write_file(path, "#!/bin/sh\n[ \"$1\" = --version ] && echo fake 1.0\n");
    fs::permissions(path, fs::perms::owner_all);
  }
  return "PATH=" + folder.path();
}

TEST(TargetCost, MistakesEndWithTheirStatusAndAHint) {
  const auto expect = [](const support::ProcessResult& result, int status, const std::string& part) {
    EXPECT_EQ(result.status, status) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  };
  expect(jourdain({"cost", "models/pendulum.toml", "--target", "cortex-m9"}), 2,
         "no target 'cortex-m9'; there are cortex-m4, cortex-m7, rv64");
  expect(jourdain({"cost", "models/pendulum.toml", "--target", "rv64", "--warm", "10"}), 2, "--warm");
  expect(jourdain({"cost", "models/pendulum.toml", "--target", "rv64", "--real", "long"}), 2, "--real");
  expect(jourdain({"cost", "models/nothing.toml", "--target", "rv64"}), 3, "models/nothing.toml");
  const std::vector<std::string> command = {"cost", "models/pendulum.toml", "--target", "cortex-m4"};
  const support::TemporaryFolder none, compiler, both;
  expect(jourdain(command, {folder_of_fakes(none, {})}), 3, "the package gcc-arm-none-eabi");
  expect(jourdain(command, {folder_of_fakes(compiler, {"arm-none-eabi-g++"})}), 3,
         "the package qemu-system-arm");
  expect(jourdain(command, {folder_of_fakes(both, {"arm-none-eabi-g++", "qemu-system-arm"})}), 3,
         "the package libnewlib-arm-none-eabi");
  expect(jourdain({"cost", "models/pendulum.toml", "--target", "rv64"}, {folder_of_fakes(none, {})}), 3,
         "the package gcc-riscv64-unknown-elf");
}

}  // namespace
}  // namespace jourdain::tests
