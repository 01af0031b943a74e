// Functions that the user of emitted code defines, compiled and run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

const std::string kData = JOURDAIN_SOURCE_DIR "/tests/data/external/";
const std::string kPrograms = JOURDAIN_SOURCE_DIR "/tests/embed/programs/";
const std::vector<std::string> kWarnings = {"-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"};

support::ProcessResult compiled(std::vector<std::string> command) {
  command.insert(command.begin() + 1, kWarnings.begin(), kWarnings.end());
  return support::run_process(command);
}

std::string without_external(std::string text) {
  const std::string line = "external = true\n";
  for (std::size_t at; (at = text.find(line)) != std::string::npos;) text.erase(at, line.size());
  return text;
}

/// A file with a slide that an external function f pushes.
std::string part_text(const std::string& name, const std::string& arguments, const std::string& force) {
  return fmt::format(R"(function = [{{ name = "f", arguments = {1}, external = true, value = "x" }}]
body = [{{ name = "{0}", mass = 1 }}]
joint = [{{ name = "slide_{0}", type = "prismatic", parent = "world", child = "{0}", axis = [1, 0, 0] }}]
force = [{{ joint = "slide_{0}", value = "{2}" }}]
)",
                     name, arguments, force);
}

/// rig, which calls functions of the user, and plain, which does not.
class ExternalFunctions : public testing::Test {
 protected:
  void emit(const std::vector<std::string>& options) {
    const std::string plain = folder_.path() + "/plain.toml";
    support::write_file(plain, without_external(support::read_file(kData + "rig.toml")));
    for (const std::string& model : {kData + "rig.toml", plain}) {
      std::vector<std::string> command = {
          JOURDAIN_BINARY,
          "compile",
          model,
          "-o",
          folder_.path(),
          "--name",
          model == plain ? "plain" : "rig",
          "--functions",
          "initial_state,forward_dynamics,rk4_step,ros34pw2_step,linearize,outputs"};
      command.insert(command.end(), options.begin(), options.end());
      const support::ProcessResult result = support::run_process(command);
      ASSERT_EQ(result.status, 0) << result.output;
    }
  }

  std::string in_folder(const std::string& file) const { return folder_.path() + "/" + file; }

  support::TemporaryFolder folder_;
};

TEST_F(ExternalFunctions, AreThoseOfATypeInCpp) {
  emit({});
  const support::ProcessResult built = compiled(
      {"g++", "-std=c++17", "-O1", "-I", folder_.path(), "-I", kData, kPrograms + "external_functions.cpp",
       in_folder("rig.cpp"), in_folder("plain.cpp"), "-o", in_folder("program")});
  ASSERT_EQ(built.status, 0) << built.output;
  const support::ProcessResult run = support::run_process({in_folder("program")});
  EXPECT_EQ(run.status, 0) << run.output;
}

TEST_F(ExternalFunctions, ArePointersInC) {
  emit({"--language", "c"});
  const support::ProcessResult built =
      compiled({"gcc", "-std=c99", "-O1", "-I", folder_.path(), kPrograms + "external_functions.c",
                in_folder("rig.c"), in_folder("plain.c"), "-o", in_folder("program"), "-lm"});
  ASSERT_EQ(built.status, 0) << built.output;
  const support::ProcessResult run = support::run_process({in_folder("program")});
  EXPECT_EQ(run.status, 0) << run.output;
}

/// What the compiler says names the file, or the member, that is missing.
TEST_F(ExternalFunctions, ThatAreMissingAreNamed) {
  emit({});
  const std::vector<std::string> command = {"g++", "-std=c++17",         "-I", folder_.path(),
                                            "-c",  in_folder("rig.cpp"), "-o", in_folder("rig.o")};
  const support::ProcessResult without = compiled(command);
  EXPECT_NE(without.status, 0);
  EXPECT_NE(without.output.find("rig_functions.hpp"), std::string::npos) << without.output;
  std::string text = support::read_file(kData + "rig_functions.hpp");
  const std::size_t begin = text.find("  Real hardening_x"), end = text.find('\n', begin);
  support::write_file(in_folder("rig_functions.hpp"), text.erase(begin, end - begin));
  const support::ProcessResult missing = compiled(command);
  EXPECT_NE(missing.status, 0);
  EXPECT_NE(missing.output.find("hardening_x"), std::string::npos) << missing.output;
}

/// Two files that are imported without a prefix.
TEST_F(ExternalFunctions, OfOneNameThatDifferAreRefused) {
  support::write_file(in_folder("a.toml"), part_text("a", "['x']", "f(slide_a)"));
  support::write_file(in_folder("b.toml"), part_text("b", "['x', 'y']", "f(slide_b, 1)"));
  const auto check = [this](const char* prefix) {
    support::write_file(
        in_folder("both.toml"),
        fmt::format("[model]\nname = \"both\"\n[[import]]\nfile = \"a.toml\"\n[[import]]\nfile = "
                    "\"b.toml\"\n{}",
                    prefix));
    return support::run_process({JOURDAIN_BINARY, "check", in_folder("both.toml")});
  };
  const support::ProcessResult refused = check("");
  EXPECT_EQ(refused.status, 1) << refused.output;
  EXPECT_NE(refused.output.find("two external functions are called 'f', and differ"), std::string::npos)
      << refused.output;
  const support::ProcessResult accepted = check("prefix = \"second_\"\n");
  EXPECT_EQ(accepted.status, 0) << accepted.output;
}

/// Functions that are written out are members of nothing: one may be the slope that another is given.
TEST_F(ExternalFunctions, MayHaveTheirSlopesWrittenOutBeside) {
  std::string text = part_text("a", "['x']", "f(slide_a) + f_x(slide_a)");
  const std::string end = "\"x\" }]";
  text.replace(text.find(end), end.size(),
               "\"x\" }, { name = \"f_x\", arguments = [\"x\"], value = \"1 + 0*x\" }]");
  support::write_file(in_folder("a.toml"), "model = { name = \"a\" }\n" + text);
  const support::ProcessResult accepted =
      support::run_process({JOURDAIN_BINARY, "check", in_folder("a.toml")});
  EXPECT_EQ(accepted.status, 0) << accepted.output;
}

/// Whatever runs a model takes the expressions: the numbers are those of the model without the key.
TEST_F(ExternalFunctions, StandForTheirExpressionsWhereAModelIsRun) {
  const std::string plain = in_folder("plain.toml");
  support::write_file(plain, without_external(support::read_file(kData + "rig.toml")));
  std::vector<std::string> outputs;
  for (const std::string& model : {kData + "rig.toml", plain}) {
    const std::string csv = in_folder("run.csv");
    const support::ProcessResult run = support::run_process(
        {JOURDAIN_BINARY, "simulate", model, "--duration", "0.5", "--step", "0.01", "--output", csv});
    ASSERT_EQ(run.status, 0) << run.output;
    outputs.push_back(support::read_file(csv));
  }
  EXPECT_EQ(outputs[0], outputs[1]);
  EXPECT_GT(outputs[0].size(), 1000u);
}

}  // namespace
}  // namespace jourdain::tests
