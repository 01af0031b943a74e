// The files in C: clean for three compilers, and the same bytes as the C++ in double and in float.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "agreement/compiled_batch.hpp"
#include "embed/c_driver.hpp"
#include "properties/effort.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

/// How many models there are at least, and numbers to compare: the sanitizers' build makes a few.
#ifdef JOURDAIN_SANITIZED
constexpr std::size_t kModels = 5;
constexpr long kNumbers = 300;
#else
constexpr std::size_t kModels = 30;
constexpr long kNumbers = 4000;
#endif

/// Names of models, and the folders that hold their C++ and their C.
struct Emitted {
  std::string name, in_cpp, in_c;
};

std::vector<Emitted> emitted() {
  std::vector<Emitted> list;
  for (const auto& [cpp, c] : {std::pair(JOURDAIN_EMITTED, JOURDAIN_EMITTED_C "/models"),
                               {JOURDAIN_STEPPERS, JOURDAIN_EMITTED_C "/steppers"}})
    for (const auto& entry : fs::directory_iterator(c)) {
      const std::string name = entry.path().filename().string();
      if (entry.is_directory() && name[0] != '.')
        list.push_back({name, fmt::format("{}/{}", cpp, name), fmt::format("{}/{}", c, name)});
    }
  std::sort(list.begin(), list.end(), [](const Emitted& a, const Emitted& b) { return a.name < b.name; });
  return list;
}

std::vector<std::string> strict_c(const std::string& compiler) {
  return {compiler,       "-std=c99",           "-pedantic", "-Wall",  "-Wextra",
          "-Wconversion", "-Wdouble-promotion", "-Wshadow",  "-Werror"};
}

support::ProcessResult run(std::vector<std::string> command, const std::vector<std::string>& more) {
  command.insert(command.end(), more.begin(), more.end());
  return support::run_process(command);
}

TEST(CLanguage, IsCleanForEveryCompiler) {
  for (const std::string compiler : {"clang", "arm-none-eabi-gcc"}) {
    ASSERT_TRUE(have_compiler(compiler)) << "no " << compiler << ": ./dev build installs it";
    for (const Emitted& model : emitted())
      for (const char* ending : {".c", "_f.c"}) {
        const auto result = run(strict_c(compiler),
                                {"-fsyntax-only", fmt::format("{}/{}{}", model.in_c, model.name, ending)});
        EXPECT_EQ(result.status, 0) << compiler << " " << model.name << "\n" << result.output.substr(0, 2000);
        EXPECT_EQ(result.output, "") << compiler << " " << model.name;
      }
  }
}

TEST(CLanguage, ComputesTheBytesOfTheCppInDoubleAndInFloat) {
  ASSERT_GE(emitted().size(), kModels);
  long compared = 0;
  std::size_t number = 0;
  for (const Emitted& model : emitted()) {
    if (!draws(number++, 2)) continue;
    const support::TemporaryFolder folder;
    std::vector<std::string> objects;
    for (const char* ending : {"", "_f"}) {
      objects.push_back(fmt::format("{}/model{}.o", folder.path(), ending));
      const auto result = run(strict_c("gcc"), {"-O1", "-ffp-contract=off", "-c", "-o", objects.back(),
                                                fmt::format("{}/{}{}.c", model.in_c, model.name, ending)});
      ASSERT_EQ(result.status, 0) << model.name << "\n" << result.output.substr(0, 2000);
    }
    const std::string driver = folder.path() + "/driver.cpp", program = folder.path() + "/driver";
    const auto header = [&](const char* ending) {
      return support::read_file(fmt::format("{}/{}{}", model.in_c, model.name, ending));
    };
    support::write_file(driver, c_driver(model.name, header(".h"), header("_f.h")));
    std::vector<std::string> command = {"g++", "-Werror"};
    for (const std::string& flag : strict_flags())
      if (flag != "-Wshadow") command.push_back(flag);
    const auto built = run(command, {"-O0", "-ffp-contract=off", "-I" + model.in_cpp, "-I" + model.in_c,
                                     driver, objects[0], objects[1], "-o", program});
    ASSERT_EQ(built.status, 0) << model.name << "\n" << built.output.substr(0, 4000);
    const auto result = support::run_process({program});
    EXPECT_EQ(result.status, 0) << model.name << "\n" << result.output.substr(0, 2000);
    compared += std::stol(result.output.substr(result.output.rfind('\n', result.output.size() - 2) + 1));
  }
  EXPECT_GT(compared, draws_all_cases() ? kNumbers : kNumbers / 3);
  fmt::print("{} results of models compared\n", compared);
}

}  // namespace
}  // namespace jourdain::tests
