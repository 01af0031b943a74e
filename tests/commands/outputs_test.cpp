// Files and streams that commands write: none that they read, no two in one place, nothing half-written.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

class Outputs : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }

  /// The pendulum under another name of its file.
  std::string pendulum_as(const std::string& name) const {
    support::write_file(path(name), kText);
    return path(name);
  }

  /// Refused with that in the message, and the description is as it was.
  void expect_refused(const std::string& model, const std::vector<std::string>& arguments,
                      const std::string& part) const {
    expect(jourdain(arguments), 2, part);
    EXPECT_EQ(support::read_file(model), kText) << arguments[0];
  }

  const std::string kText = support::read_file(JOURDAIN_SOURCE_DIR "/models/pendulum.toml");

 private:
  support::TemporaryFolder folder_;
};

/// By a shell that does `before` and sends standard output to `out`.
support::ProcessResult in_shell(const std::string& before, const std::string& out,
                                const std::vector<std::string>& arguments) {
  const std::string script = before + " exec \"$0\" \"$@\"" + (out.empty() ? "" : " >" + out);
  std::vector<std::string> command = {"env", "-C", JOURDAIN_SOURCE_DIR, "sh", "-c", script, JOURDAIN_BINARY};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

TEST_F(Outputs, AreNotTheDescription) {
  const std::string model = pendulum_as("pendulum.toml"), overwritten = "is read, and would be overwritten";
  std::filesystem::create_symlink("pendulum.toml", path("link"));
  expect_refused(model, {"simulate", model, "--output", model}, overwritten);
  expect_refused(model, {"simulate", model, "--output", path("link")}, overwritten);
  expect_refused(model, {"simulate", model, "--output", path("nowhere/../pendulum.toml")}, overwritten);
  expect_refused(model, {"fmu", model, "-o", model}, overwritten);
  expect_refused(model, {"cost", model, "-o", model}, overwritten);
  expect_refused(model, {"compile", model, "-o", path("out"), "--depfile", model}, overwritten);
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(Outputs, InAFolderAreNotTheDescriptionEither) {
  const std::string manifest = pendulum_as("pendulum.json"), module = pendulum_as("pendulum.py"),
                    source = pendulum_as("pendulum.c"), folder = path(""),
                    overwritten = "is read, and would be overwritten";
  expect_refused(manifest, {"compile", manifest, "-o", folder, "--functions", "mass_matrix"}, overwritten);
  expect_refused(module, {"python", module, "-o", folder}, overwritten);
  expect_refused(source, {"wrap", source, "--for", "casadi", "-o", folder}, overwritten);
  EXPECT_FALSE(std::filesystem::exists(path("pendulum.hpp")));
}

TEST_F(Outputs, AreNotWhatIsImportedOrDrivesARun) {
  const std::string part = pendulum_as("part.toml"), model = path("whole.toml"), table = path("u.csv");
  support::write_file(model, "[model]\nname = \"whole\"\n[[import]]\nfile = \"part.toml\"\n");
  expect_refused(part, {"fmu", model, "-o", part}, "part.toml: is read, and would be overwritten");
  support::write_file(table, "time,push\n0,0\n");
  expect(jourdain({"simulate", "models/cart_pole.toml", "--inputs", table, "--output", table}), 2,
         "u.csv: is read, and would be overwritten");
}

TEST_F(Outputs, AreEachAnotherFile) {
  const std::string twice = "two files are to be written there", picture = path("a.svg");
  expect(jourdain({"simulate", "models/pendulum.toml", "--output", picture, "--plot", "pivot", picture}), 2,
         twice);
  expect(jourdain({"compile", "models/pendulum.toml", "-o", path("out"), "--functions", "mass_matrix",
                   "--depfile", path("out/pendulum.hpp")}),
         2, twice);
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  expect(jourdain({"compile", "models/pendulum.toml", "-o", path("out"), "--functions", "mass_matrix",
                   "--depfile", path("out/pendulum.d")}),
         0, "wrote");
}

TEST_F(Outputs, OfAFullDiskAreAnError) {
  for (const std::string command : {"check", "keys"}) {  // less and more than is held back
    std::vector<std::string> arguments = {command};
    if (command == "check") arguments.emplace_back("models/pendulum.toml");
    expect(in_shell("", "/dev/full", arguments), 3, "error: standard output cannot be written");
  }
  expect(in_shell("", "/dev/full", {"--help"}), 3, "standard output cannot be written");
  EXPECT_EQ(in_shell("", "/dev/full", {"check", "models/nothing.toml"}).status, 3);
}

TEST_F(Outputs, BeyondALimitOfSizeAreAnErrorThatLeavesNothing) {
  expect(in_shell("ulimit -f 4;", "", {"compile", "models/pendulum.toml", "-o", path("out")}), 3,
         "cannot be written: File too large");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(Outputs, HaveNames) {
  const std::string model = pendulum_as("pendulum.toml"), out = path("out");
  const std::vector<std::vector<std::string>> commands = {{"simulate", model, "--output"},
                                                          {"simulate", model, "--inputs"},
                                                          {"ensemble", model, "--output"},
                                                          {"ensemble", model, "--plot"},
                                                          {"merge", path("all.h5"), path("1.h5"), "--plot"},
                                                          {"compile", model, "-o"},
                                                          {"compile", model, "-o", out, "--depfile"},
                                                          {"check", model, "--against"},
                                                          {"report", model, "-o"},
                                                          {"fmu", model, "-o"},
                                                          {"python", model, "-o"},
                                                          {"wrap", model, "--for", "casadi", "-o"},
                                                          {"cost", model, "-o"}};
  for (std::vector<std::string> command : commands) {
    command.emplace_back("");
    expect(jourdain(command), 2, ": the name is empty");
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace jourdain::tests
