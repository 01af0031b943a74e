// jourdain_add_model: what it says of bad use, and when it makes a model anew.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "package/project.hpp"
#include "support/files.hpp"

namespace jourdain::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kArm = R"([model]
name = "arm"
[[body]]
name = "bob"
mass = 2
center_of_mass = [0, -0.5, 0]
[[joint]]
name = "hinge"
type = "revolute"
parent = "world"
child = "bob"
)";

/// What CMake prints, without the line breaks that it puts into messages.
std::string unbroken(const std::string& text) {
  std::string words;
  for (const char c : text)
    if (c != ' ' && c != '\n')
      words += c;
    else if (!words.empty() && words.back() != ' ')
      words += ' ';
  return words;
}

void expect_message(const std::string& call, const std::string& message) {
  const Project project(call, "NONE");
  project.write("arm.toml", kArm);
  const support::ProcessResult result = project.configure();
  EXPECT_NE(result.status, 0) << call;
  EXPECT_THAT(unbroken(result.output), HasSubstr(message)) << call;
}

TEST(AddModel, SaysWhatIsWrongWithItsArguments) {
  expect_message("jourdain_add_model(arm)",
                 "jourdain_add_model(arm): MODEL is missing, the description of the mechanism");
  expect_message("jourdain_add_model(arm MODEL arm.toml FUNCTION rk4_step)",
                 "jourdain_add_model(arm): 'FUNCTION' is no keyword; there are MODEL, NAME, ROOT, LANGUAGE, "
                 "REAL, INTERFACE, FUNCTIONS, FRAMES, OPTIONS");
  expect_message("jourdain_add_model(arm MODEL arm.toml NAME)", "NAME needs a value");
  expect_message("jourdain_add_model(arm MODEL nothing.toml)", "there is no file");
  expect_message("jourdain_add_model(arm MODEL arm.toml ROOT loose)",
                 "ROOT is 'loose', must be one of fixed, free");
  expect_message("jourdain_add_model(arm MODEL arm.toml REAL half)",
                 "REAL is 'half', must be one of float, double, both");
  expect_message("jourdain_add_model(arm MODEL arm.toml LANGUAGE ada)",
                 "LANGUAGE is 'ada', must be one of cpp, c");
  expect_message("jourdain_add_model(arm MODEL arm.toml INTERFACE)",
                 "INTERFACE is in C, it needs LANGUAGE c");
  expect_message("jourdain_add_model(arm MODEL arm.toml OPTIONS --strict --language c)",
                 "OPTIONS has --language; NAME, LANGUAGE, REAL and INTERFACE say which files there are");
  expect_message("jourdain_add_model(arm MODEL arm.toml LANGUAGE c OPTIONS --real=float)",
                 "OPTIONS has --real=float;");
  expect_message("jourdain_add_model(arm MODEL \"a;b.toml\")", "a;b.toml', which has a semicolon");
  expect_message("jourdain_add_model(my-arm MODEL arm.toml)",
                 "'my-arm' cannot be the name of a namespace and of files; choose one with NAME");
  expect_message("add_custom_target(arm)\njourdain_add_model(arm MODEL arm.toml)",
                 "there is a target of this name already");
  expect_message("jourdain_add_model(left MODEL arm.toml NAME arm)\njourdain_add_model(arm MODEL arm.toml)",
                 "the name 'arm' is taken by the model of target 'left'");
}

TEST(FindPackage, SaysWhyThereIsNone) {
  const Project other("", "NONE", "0.2 REQUIRED");
  EXPECT_THAT(unbroken(other.configure().output), HasSubstr("requested version \"0.2\""));
  const Project project("", "NONE");
  EXPECT_THAT(unbroken(project.configure({"-DJOURDAIN_COMMAND=/bin/false"}).output),
              HasSubstr("'/bin/false' does not run on this machine (1)"));
  EXPECT_THAT(unbroken(project.configure({"-DJOURDAIN_COMMAND=./false"}).output),
              HasSubstr("JOURDAIN_COMMAND is './false', must be an absolute path"));
  project.write("older", "#!/bin/sh\necho jourdain 0.0.9\n");
  std::filesystem::permissions(project.folder() + "/older", std::filesystem::perms::owner_all);
  EXPECT_THAT(unbroken(project.configure({"-DJOURDAIN_COMMAND=" + project.folder() + "/older"}).output),
              HasSubstr("is jourdain 0.0.9, this package is of "));
  EXPECT_EQ(project.configure({"-DJOURDAIN_COMMAND=" JOURDAIN_BINARY}).status, 0);
}

/// A target that is called as the C library's part for mathematics, in a unity build.
TEST(AddModel, MakesALibraryOfCWhateverTheProjectSets) {
  const Project project(
      "set(CMAKE_UNITY_BUILD ON)\njourdain_add_model(m MODEL arm.toml LANGUAGE c INTERFACE NAME arm)", "C");
  project.write("arm.toml", kArm);
  const support::ProcessResult configured = project.configure();
  ASSERT_EQ(configured.status, 0) << configured.output;
  const support::ProcessResult built = project.build();
  EXPECT_EQ(built.status, 0) << built.output;
}

class Rebuild : public testing::TestWithParam<const char*> {};

TEST_P(Rebuild, FollowsWhatTheDescriptionImports) {
  const Project project(
      "jourdain_add_model(cell MODEL cell.toml FUNCTIONS initial_state mass_matrix FRAMES tip=bob:pose)");
  project.write("cell.toml", "[model]\nname = \"a cell\"\n[[import]]\nfile = \"parts/my arm.toml\"\n");
  std::filesystem::create_directory(project.folder() + "/parts");
  const std::string part = "parts/my arm.toml";
  project.write(part, kArm);
  ASSERT_EQ(project.configure({}, GetParam()).status, 0);
  const auto built = [&project] {
    const support::ProcessResult result = project.build();
    EXPECT_EQ(result.status, 0) << result.output;
    return result.output;
  };
  const auto kernels = [&project] {
    return support::read_file(project.folder() + "/build/jourdain/cell/cell_kernels.hpp");
  };
  constexpr const char* kMade = "Compiling cell.toml";
  EXPECT_THAT(built(), HasSubstr(kMade));
  EXPECT_THAT(built(), Not(HasSubstr(kMade))) << "nothing has changed";
  EXPECT_THAT(kernels(), HasSubstr("0.5"));  // M = 2 kg (0.5 m)²

  std::filesystem::last_write_time(project.folder() + "/" + part,
                                   std::filesystem::file_time_type::clock::now());
  EXPECT_THAT(built(), HasSubstr(kMade)) << "the imported file is newer";
  EXPECT_THAT(built(), Not(HasSubstr(kMade))) << "what stays the same counts as made";

  std::string heavier = kArm;
  heavier.replace(heavier.find("mass = 2"), 8, "mass = 5");
  project.write(part, heavier);
  EXPECT_THAT(built(), HasSubstr(kMade));
  EXPECT_THAT(kernels(), HasSubstr("1.25"));

  std::string wrong = kArm;
  wrong.replace(wrong.find("mass = 2"), 8, "mas = 2 ");
  project.write(part, wrong);
  const support::ProcessResult refused = project.build();
  EXPECT_NE(refused.status, 0);
  EXPECT_THAT(refused.output, HasSubstr("my arm.toml:5:1: error: unknown key 'mas'"));

  project.write(part, kArm);
  built();
  EXPECT_THAT(kernels(), Not(HasSubstr("1.25")));
}

INSTANTIATE_TEST_SUITE_P(Generators, Rebuild, testing::Values("Ninja", "Unix Makefiles"),
                         [](const auto& generator) { return generator.index == 0 ? "Ninja" : "Makefiles"; });

/// What the target's root holds is all that is found but by find_package(... CMAKE_FIND_ROOT_PATH_BOTH).
TEST(AddModel, WorksWhenCrossCompiling) {
  const Project project("jourdain_add_model(arm MODEL arm.toml FUNCTIONS initial_state rk4_step)", "CXX",
                        "REQUIRED CMAKE_FIND_ROOT_PATH_BOTH");
  project.write("arm.toml", kArm);
  project.write("cortex_m7.cmake",
                "set(CMAKE_SYSTEM_NAME Generic)\nset(CMAKE_SYSTEM_PROCESSOR arm)\n"
                "set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)\n"
                "set(CMAKE_CXX_COMPILER arm-none-eabi-g++)\n"
                "set(CMAKE_CXX_FLAGS_INIT \"-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16\")\n"
                "set(CMAKE_FIND_ROOT_PATH ${CMAKE_CURRENT_LIST_DIR}/root)\n"
                "set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)\nforeach(kind LIBRARY INCLUDE PACKAGE)\n"
                "  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)\nendforeach()\n");
  const support::ProcessResult configured =
      project.configure({"--toolchain", project.folder() + "/cortex_m7.cmake"});
  ASSERT_EQ(configured.status, 0) << configured.output;
  const support::ProcessResult built = project.build();
  ASSERT_EQ(built.status, 0) << built.output;
  const std::string library = project.folder() + "/build/libarm.a";
  EXPECT_THAT(support::run_process({"arm-none-eabi-readelf", "-h", library}).output, HasSubstr("ARM"));
}

}  // namespace
}  // namespace jourdain::tests
