// What is installed beside the command, and the Debian package.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "package/project.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string installed(const std::string& file) { return support::read_file(installation() + "/" + file); }

/// Words of a text that match.
std::set<std::string> words(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), expression); match != std::sregex_iterator();
       ++match)
    found.insert((*match)[1]);
  return found;
}

std::string help(const std::string& command) {
  return support::run_process({JOURDAIN_BINARY, command, "--help"}).output;
}

std::set<std::string> commands() {
  const std::string text = support::run_process({JOURDAIN_BINARY, "--help"}).output;
  return words(text.substr(text.find("Subcommands:")), "\n  ([a-z]+) ");
}

TEST(Installed, ManualAndCompletionNameEveryCommandAndOption) {
  ASSERT_GE(commands().size(), 9u);
  const std::string bash = installed("share/bash-completion/completions/jourdain");
  const std::string zsh = installed("share/zsh/vendor-completions/_jourdain");
  const std::string overview = installed("share/man/man1/jourdain.1");
  for (const std::string& command : commands()) {
    EXPECT_THAT(overview, HasSubstr("jourdain " + command));
    const std::string page = installed("share/man/man1/jourdain-" + command + ".1");
    const std::string line = bash.substr(bash.find("    " + command + ") options="));
    const std::string listed = line.substr(0, line.find('\n'));
    const std::string arguments = zsh.substr(zsh.find("    " + command + ") _arguments"));
    const std::set<std::string> options = words(help(command), "(?:\n  |,)(--[a-z-]+)");
    EXPECT_GE(options.size(), 1u) << command;
    for (const std::string& option : options) {
      EXPECT_THAT(page, HasSubstr("\\fB" + std::regex_replace(option, std::regex("-"), "\\-") + "\\fR"))
          << command;
      EXPECT_THAT(listed + " ", testing::ContainsRegex(" " + option + "[ \"]")) << command;
      EXPECT_THAT(arguments.substr(0, arguments.find(";;")), HasSubstr(option + "[")) << command;
    }
  }
}

TEST(Installed, BashCompletesCommandsOptionsAndWords) {
  const auto completed = [](const std::string& line) {
    const std::string script = fmt::format(
        "source {}/share/bash-completion/completions/jourdain; COMP_WORDS=({}); "
        "COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _jourdain; echo \"${{COMPREPLY[@]}}\"",
        installation(), line);
    return support::run_process({"bash", "-c", script}).output;
  };
  EXPECT_EQ(completed("jourdain co"), "compile cost\n");
  EXPECT_EQ(completed("jourdain check --ag"), "--against\n");
  EXPECT_EQ(completed("jourdain compile arm.urdf --root f"), "fixed free\n");
  EXPECT_EQ(completed("jourdain keys jo"), "joint\n");
}

TEST(Installed, TheDebianPackageWorksFromWhereItIsUnpacked) {
  const support::TemporaryFolder folder;
  const support::ProcessResult made =
      support::run_process({"cpack", "--config", build_folder() + "/CPackConfig.cmake", "-B", folder.path()});
  ASSERT_EQ(made.status, 0) << made.output;
  std::string package;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    if (entry.path().extension() == ".deb") package = entry.path().string();
  ASSERT_FALSE(package.empty()) << made.output;
  EXPECT_THAT(support::run_process({"dpkg-deb", "-f", package, "Depends"}).output,
              testing::AllOf(HasSubstr("libginac"), HasSubstr("libcln"), HasSubstr("libc6")));
  const std::string root = folder.path() + "/root";
  ASSERT_EQ(support::run_process({"dpkg-deb", "-x", package, root}).status, 0);
  fs::copy_file(JOURDAIN_SOURCE_DIR "/models/pendulum.toml", folder.path() + "/pendulum.toml");
  for (const char* command :
       {"compile pendulum.toml -o out", "check pendulum.toml --against out", "info pendulum.toml",
        "simulate pendulum.toml --duration 0.1", "cost pendulum.toml --warm 10 --cold 10"}) {
    const support::ProcessResult result = run_script(folder.path(), root + "/usr/bin/jourdain " + command);
    EXPECT_EQ(result.status, 0) << command << "\n" << result.output;
  }
  for (const char* file :
       {"bin/jourdain", "include/jourdain/long_real.hpp", "share/cmake/jourdain/jourdainConfig.cmake",
        "share/man/man1/jourdain-compile.1", "share/bash-completion/completions/jourdain",
        "share/jourdain/model.schema.json", "share/doc/jourdain/copyright"})
    EXPECT_TRUE(fs::exists(root + "/usr/" + file)) << file;
}

}  // namespace
}  // namespace jourdain::tests
