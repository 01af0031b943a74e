// Packs and ensembles as compilers make them: with the vectors of the machine, and with flags that they cannot do with.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

const std::string kRuntime = JOURDAIN_SOURCE_DIR "/runtime";

/// By registers of all sizes: the range is tested in each by an instruction of its own.
TEST(CompiledPacks, CallTheLibraryForLanesOutOfRangeAlone) {
  const support::TemporaryFolder folder;
  const std::string program = folder.path() + "/range";
  for (const char* compiler : {"g++", "clang++"})
    for (const char* flag : {"-march=native", "-O2"}) {
      const support::ProcessResult built = support::run_process(
          {compiler, "-std=c++17", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wno-psabi", flag,
           "-I", kRuntime, "-o", program, JOURDAIN_SOURCE_DIR "/tests/ensemble/programs/range.cpp"});
      ASSERT_EQ(built.status, 0) << built.output;
      EXPECT_EQ(support::run_process({program}).output, "0 0 0 0 0 0 0\n") << compiler << flag;
    }
}

/// What g++ adds up in another order is no sine, and what is finite by decree is always trusted.
TEST(CompiledPacks, RefuseFlagsThatBreakThem) {
  const support::TemporaryFolder folder;
  const auto compiled = [&folder](const std::string& compiler, const std::string& header,
                                  const std::vector<std::string>& flags) {
    const std::string source = folder.path() + "/use.cpp";
    support::write_file(source, "#include <jourdain/" + header + ">\n");
    std::vector<std::string> command = {compiler, "-std=c++17", "-fsyntax-only", "-I", kRuntime, source};
    command.insert(command.end(), flags.begin(), flags.end());
    return support::run_process(command);
  };
  const auto expect_refusal = [&compiled](const std::string& compiler, const std::string& header,
                                          const std::vector<std::string>& flags) {
    const support::ProcessResult result = compiled(compiler, header, flags);
    EXPECT_NE(result.status, 0) << compiler << header << flags[0];
    EXPECT_NE(result.output.find("no -ffast-math, -Ofast, -ffinite-math-only"), std::string::npos)
        << result.output;
  };
  for (const char* flag : {"-ffast-math", "-Ofast", "-ffinite-math-only"})
    for (const char* compiler : {"g++", "clang++"})
      for (const char* header : {"ensemble.hpp", "device_ensemble.hpp", "pack.hpp"})
        expect_refusal(compiler, header, {flag});
  expect_refusal("g++", "pack.hpp", {"-fassociative-math", "-fno-signed-zeros", "-fno-trapping-math"});
  EXPECT_EQ(compiled("g++", "ensemble.hpp", {"-O3", "-fno-math-errno"}).status, 0);
}

}  // namespace
}  // namespace jourdain::tests
