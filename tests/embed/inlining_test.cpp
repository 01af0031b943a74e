// Short functions are compiled into the steps that call them, where code may be long.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "embed/emit_model.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// Calls of a function of the model, and jumps to it, in the emitted source as a compiler translates it.
int calls(const std::string& compiler, const std::string& option, const std::string& model,
          const std::string& function) {
  const support::TemporaryFolder folder;
  const std::string assembly = folder.path() + "/model.s";
  const support::ProcessResult compiled =
      support::run_process({compiler, "-std=c++17", option, "-S",
                            fmt::format("{}/{}/{}.cpp", JOURDAIN_EMITTED, model, model), "-o", assembly});
  EXPECT_EQ(compiled.status, 0) << compiled.output;
  std::istringstream lines(support::read_file(assembly));
  const std::string symbol = fmt::format("_ZN{}{}{}{}I", model.size(), model, function.size(), function);
  int found = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string instruction, target;
    words >> instruction >> target;
    found += (instruction.find("call") == 0 || instruction == "jmp" || instruction == "bl" ||
              instruction == "b") &&
             target.find(symbol) == 0;
  }
  return found;
}

#if defined(__x86_64__) || defined(__aarch64__)
TEST(Inlining, TakesShortFunctionsIntoSteps) {
  for (const std::string compiler : {"g++", "clang++"}) {
    EXPECT_EQ(calls(compiler, "-O2", "cart_pole", "forward_dynamics"), 0) << compiler;
    for (const std::string function : {"forward_dynamics", "position_rate", "close_loops"})
      EXPECT_EQ(calls(compiler, "-O2", "four_bar", function), 0) << compiler << " " << function;
  }
}
#endif

TEST(Inlining, LeavesCallsWhereCodeIsSmallOrFunctionsAreLong) {
  for (const std::string compiler : {"g++", "clang++"}) {
    EXPECT_GT(calls(compiler, "-Os", "quadrotor", "forward_dynamics"), 0) << compiler;
    EXPECT_GT(calls(compiler, "-O2", "panda", "forward_dynamics"), 0) << compiler;
    EXPECT_GT(calls(compiler, "-O2", "squeezer", "forward_dynamics"), 0) << compiler;
  }
}

TEST(Inlining, IsAskedForWhereStepsCallWhatIsShort) {
  const support::TemporaryFolder folder;
  const auto kernels = [&](const std::string& model, const std::vector<std::string>& options) {
    emit_model(model, folder.path() + "/" + model, options);
    return support::read_file(fmt::format("{0}/{1}/{1}_kernels.hpp", folder.path(), model));
  };
  const std::string four_bar = kernels("four_bar", {"--functions", "rk4_step"});
  for (const char* function : {"accelerations(", "forward_dynamics(", "position_rate(", "close_loops("})
    EXPECT_NE(four_bar.find(fmt::format("JOURDAIN_INLINED\nvoid {}", function)), std::string::npos)
        << function;
  const auto source = [&](const std::string& model) {
    return support::read_file(fmt::format("{0}/{1}/{1}.cpp", folder.path(), model));
  };
  EXPECT_NE(four_bar.find("class InputAt> JOURDAIN_FUNCTION JOURDAIN_STAGES\nvoid rk4_step("),
            std::string::npos);
  EXPECT_NE(source("four_bar")
                .find("template JOURDAIN_FUNCTION JOURDAIN_STAGES void rk4_step(const Model<double>&"),
            std::string::npos);
  const std::string panda = kernels("panda", {});
  EXPECT_EQ((panda + source("panda")).find("JOURDAIN_STAGES"), std::string::npos);
  EXPECT_EQ(panda.find("JOURDAIN_INLINED"), std::string::npos);
  const std::string no_step = kernels("cart_pole", {"--functions", "forward_dynamics,mass_matrix"});
  EXPECT_EQ(no_step.find("JOURDAIN_INLINED"), std::string::npos);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
/// What users' other options say stays as it is in steps that g++ does not vectorise.
TEST(Inlining, KeepsOptionsInUnvectorisedSteps) {
  const support::TemporaryFolder folder;
  const std::string name = "slider_crank", source = fmt::format("{0}/{1}/{1}.cpp", JOURDAIN_EMITTED, name);
  const auto in_steps = [&](const std::vector<std::string>& options, const std::string& instruction) {
    std::vector<std::string> command{"g++", "-std=c++17", "-O3", "-mfma",
                                     "-S",  source,       "-o",  folder.path() + "/m.s"};
    command.insert(command.begin() + 3, options.begin(), options.end());
    const support::ProcessResult compiled = support::run_process(command);
    EXPECT_EQ(compiled.status, 0) << compiled.output;
    std::istringstream lines(support::read_file(folder.path() + "/m.s"));
    bool is_step = false;
    int found = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.ends_with(":") && line.starts_with("_Z")) is_step = line.find("rk4_step") != std::string::npos;
      found += is_step && line.find(instruction) != std::string::npos;
    }
    return found;
  };
  EXPECT_GT(in_steps({}, "vfm"), 0);
  EXPECT_EQ(in_steps({"-ffp-contract=off"}, "vfm"), 0);
  EXPECT_GT(in_steps({}, "sqrt@PLT") + in_steps({}, "call\tsqrt"), 0);
  EXPECT_EQ(in_steps({"-fno-math-errno"}, "sqrt@PLT") + in_steps({"-fno-math-errno"}, "call\tsqrt"), 0);
}
#endif

}  // namespace
}  // namespace jourdain::tests
