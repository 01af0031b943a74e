// `jourdain fmu`: the same bytes every time, what it refuses, and that its C is clean.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "fmu/importer.hpp"
#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

support::ProcessResult fmu_command(const std::string& model, const std::vector<std::string>& more) {
  std::vector<std::string> command = {JOURDAIN_BINARY, "fmu",
                                      fmt::format("{}/models/{}", JOURDAIN_SOURCE_DIR, model)};
  command.insert(command.end(), more.begin(), more.end());
  return support::run_process(command);
}

TEST(FmuCommand, WritesTheSameBytesAgain) {
  const support::TemporaryFolder folder;
  const std::string other = folder.path() + "/again.fmu";
  for (const char* version : {"2", "3"}) {
    const std::string first = make_fmu("cart_pole", *version - '0', "--step 0.001");
    const auto result = fmu_command("cart_pole.toml", {"-o", other, "--fmi", version, "--step", "0.001"});
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_EQ(support::read_file(first), support::read_file(other));
  }
}

TEST(FmuCommand, GivesOtherModelsAndMethodsOtherTokens) {
  const std::string base = "--sources-only --step 0.001";
  const Fmu one(make_fmu("cart_pole", 2, base), false),
      method(make_fmu("cart_pole", 2, base + " --method heun"), false),
      step(make_fmu("cart_pole", 2, "--sources-only --step 0.002"), false);
  EXPECT_NE(one.token(), method.token());
  EXPECT_NE(one.token(), step.token());
}

struct Wrong {
  const char* model;
  std::vector<std::string> arguments;
  int status;
  const char* message;
};

TEST(FmuCommand, RefusesInWords) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/model.fmu";
  const Wrong cases[] = {
      {"cart_pole.toml", {"--fmi", "1"}, 2, "--fmi"},
      {"cart_pole.toml", {"--method", "rk44"}, 2, "did you mean 'rk4'"},
      {"cart_pole.toml", {"--step", "0"}, 2, "--step"},
      {"cart_pole.toml", {"--step", "nan"}, 2, "--step"},
      {"cart_pole.toml", {"--method", "rodas4", "--derivatives", "applied"}, 2, "needs all derivatives"},
      {"cart_pole.toml", {"--name", "fmi2"}, 2, "choose another name"},
      {"cart_pole.toml", {"--compiler", "no_such_compiler"}, 3, "no_such_compiler"},
      {"cart_pole.toml", {"--flags", "--no-such-flag"}, 3, "no-such-flag"},
      {"cart_pole.toml", {"-o", "/no/such/folder/model.fmu"}, 3, "/no/such/folder"},
      {"no_such_model.toml", {}, 3, "no_such_model"},
  };
  for (const Wrong& wrong : cases) {
    std::vector<std::string> arguments = wrong.arguments;
    if (arguments.empty() || arguments.front() != "-o") arguments.insert(arguments.end(), {"-o", file});
    const support::ProcessResult result = fmu_command(wrong.model, arguments);
    EXPECT_EQ(result.status, wrong.status) << wrong.message << result.output;
    EXPECT_NE(result.output.find(wrong.message), std::string::npos) << result.output;
    EXPECT_FALSE(fs::exists(file)) << wrong.message;
  }
}

struct Source {
  const char* model;
  int version;
};

class Sources : public testing::TestWithParam<Source> {
 protected:
  Fmu fmu_{make_fmu(GetParam().model, GetParam().version, "--sources-only"), false};

  std::vector<std::string> files() const {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(fmu_.folder() + "/sources"))
      if (entry.path().extension() == ".c") list.push_back(entry.path().string());
    return list;
  }
};

TEST_P(Sources, CompileWithoutAWarning) {
  for (const char* compiler : {"gcc", "clang"}) {
    std::vector<std::string> command = {compiler,
                                        "-std=c99",
                                        "-fsyntax-only",
                                        "-Wall",
                                        "-Wextra",
                                        "-Wpedantic",
                                        "-Wconversion",
                                        "-Wshadow",
                                        "-Wvla",
                                        "-Wdouble-promotion",
                                        "-Wstrict-prototypes",
                                        "-Wmissing-prototypes",
                                        "-Wcast-qual",
                                        "-Werror"};
    for (const std::string& file : files()) command.push_back(file);
    const support::ProcessResult result = support::run_process(command);
    EXPECT_EQ(result.status, 0) << result.output;
  }
}

TEST_P(Sources, BearCallsInAnyOrderUnderSanitizers) {
  const std::string program = fmu_.folder() + "/random_calls";
  std::vector<std::string> command = {
      "gcc",
      "-std=c99",
      "-O1",
      "-g",
      "-fsanitize=address,undefined",
      "-fno-sanitize-recover=all",
      "-I" + fmu_.folder() + "/sources",
      fmt::format("{}/tests/fmu/random_calls_{}.c", JOURDAIN_SOURCE_DIR, GetParam().version)};
  for (const std::string& file : files()) command.push_back(file);
  command.insert(command.end(), {"-o", program, "-lm"});
  const support::ProcessResult built = support::run_process(command);
  ASSERT_EQ(built.status, 0) << built.output;
  const support::ProcessResult result = support::run_process({program, fmu_.token(), "30000", "1"});
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("30000 calls"), std::string::npos) << result.output;
}

INSTANTIATE_TEST_SUITE_P(Models, Sources,
                         testing::Values(Source{"cart_pole", 2}, Source{"quadrotor", 2},
                                         Source{"cart_pole", 3}, Source{"squeezer", 3},
                                         Source{"n_four_bar", 3}),
                         [](const auto& one) {
                           return fmt::format("{}_{}", one.param.model, one.param.version);
                         });

}  // namespace
}  // namespace jourdain::tests
