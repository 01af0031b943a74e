// The page about ensembles: its commands as they stand there, and what its program does. Ensembles under sanitizers.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "package/project.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

const std::string kSource = JOURDAIN_SOURCE_DIR;

TEST(EnsemblesPage, SwingsThePoleUp) {
  const std::string text = support::read_file(kSource + "/runtime/ensembles.md"), fence = "```sh\n";
  const std::size_t begin = text.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t first = begin + fence.size();
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      run_script(kSource, text.substr(first, text.find("\n```", first) - first),
                 {"BUILD=" + build_folder(), "PROJECT=" + folder.path() + "/cart_pole"});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::string last_line = result.output.substr(result.output.rfind('\n', result.output.size() - 2) + 1);
  double angle = 9, place = 9;
  ASSERT_EQ(std::sscanf(last_line.c_str(), "%lf rad from upright and %lf m", &angle, &place), 2)
      << result.output;
  EXPECT_LT(std::fabs(angle), 0.2);
  EXPECT_LT(std::fabs(place), 0.5);
}

TEST(EnsemblesPage, StepsManyStatesInC) {
  const std::string text = support::read_file(kSource + "/runtime/ensembles.md"),
                    section = text.substr(text.find("## From C")), fence = "```sh\n";
  const std::size_t first = section.find(fence) + fence.size();
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      run_script(kSource, section.substr(first, section.find("\n```", first) - first),
                 {"BUILD=" + build_folder(), "PROJECT=" + folder.path() + "/crane"});
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("1000 of 1000 states are to be trusted"), std::string::npos) << result.output;
}

TEST(EnsemblesPage, ProgramsOfThreadsDoNotMeet) {
  const support::TemporaryFolder folder;
  const auto run_checked = [](const std::vector<std::string>& command) {
    const support::ProcessResult result = support::run_process(command);
    ASSERT_EQ(result.status, 0) << command[0] << "\n" << result.output;
  };
  run_checked(
      {JOURDAIN_BINARY, "compile", kSource + "/models/four_bar.toml", "--packs", "-o", folder.path()});
  for (const char* sanitizers : {"-fsanitize=thread", "-fsanitize=address,undefined"}) {
    const std::string program = folder.path() + "/threads";
    run_checked({"g++", "-std=c++17", "-O1", "-g", "-Wall", "-Wextra", "-Wpedantic", "-Werror", sanitizers,
                 "-fno-sanitize-recover=all", "-I", kSource + "/runtime", "-I", folder.path(),
                 kSource + "/tests/ensemble/programs/threads.cpp", folder.path() + "/four_bar.cpp", "-o",
                 program, "-pthread"});
    run_checked({program});
  }
}

}  // namespace
}  // namespace jourdain::tests
