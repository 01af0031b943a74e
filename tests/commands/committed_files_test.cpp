// `check --against`, and what `compile` leaves for it and for build systems.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kPendulum = JOURDAIN_SOURCE_DIR "/models/pendulum.toml";

class Against : public testing::Test {
 protected:
  /// Compiles the pendulum into the folder.
  void make(std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"compile", kPendulum, "-o", path("")});
    const support::ProcessResult result = jourdain(options);
    ASSERT_EQ(result.status, 0) << result.output;
  }

  support::ProcessResult check(std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"check", kPendulum, "--against", path("")});
    return jourdain(options);
  }

  std::string path(const std::string& file) const { return folder_.path() + "/out/" + file; }

 private:
  support::TemporaryFolder folder_;
};

TEST_F(Against, TheCommittedFilesOfAModel) {
  EXPECT_EQ(jourdain({"check", kPendulum, "--against", JOURDAIN_SOURCE_DIR "/generated/pendulum"}).status, 0);
}

TEST_F(Against, TakesTheOptionsThatTheFolderWasMadeWith) {
  make({"--functions", "initial_state,rk4_step,center_of_mass", "--frame", "tip=bob:pose,jacobian:frame",
        "--frame", "hand=bob", "--libm", "--snap", "1e-3", "--name", "swing"});
  const support::ProcessResult result = check();
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("4 files, the same byte for byte"));
  EXPECT_EQ(check({"--clock"}).status, 1) << "options that are given are all";
}

TEST_F(Against, ShowsTheFirstDifferenceOfEachFileAndWritesNothing) {
  make();
  std::string text = support::read_file(path("pendulum.cpp"));
  const std::size_t at = text.find("#include");
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
  text.replace(at, 8, "#inclade");
  support::write_file(path("pendulum.cpp"), text);
  text = support::read_file(path("pendulum.hpp"));
  support::write_file(path("pendulum.hpp"), text.substr(0, text.size() - 3));
  fs::remove(path("pendulum_kernels.hpp"));
  const support::ProcessResult result = check();
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(
      result.output,
      HasSubstr(fmt::format("pendulum.cpp:{}:6: error: differs\n  there: #inclade \"pendulum_ker", line)));
  EXPECT_THAT(result.output, HasSubstr("  now:   #include \"pendulum_ker"));
  EXPECT_THAT(result.output, testing::ContainsRegex("pendulum.hpp:[0-9]+:[0-9]+: error: differs"));
  EXPECT_THAT(result.output, HasSubstr("pendulum_kernels.hpp: error: missing"));
  EXPECT_THAT(result.output, Not(HasSubstr("pendulum.json:")));
  EXPECT_THAT(result.output, HasSubstr("3 of 4 files are not what"));
  EXPECT_FALSE(fs::exists(path("pendulum_kernels.hpp")));
}

TEST_F(Against, FilesThatEndTooEarlyOrGoOn) {
  make();
  const std::string text = support::read_file(path("pendulum.json"));
  support::write_file(path("pendulum.json"), text + "more\n");
  EXPECT_THAT(check().output, HasSubstr("there: more\n  now:   (the file ends)"));
}

TEST_F(Against, NothingAndWhatIsNoManifest) {
  const support::ProcessResult empty = check();
  EXPECT_EQ(empty.status, 1);
  EXPECT_THAT(empty.output, HasSubstr("pendulum.json: error: missing"));
  EXPECT_FALSE(fs::exists(path("")));
  fs::create_directory(path(""));
  support::write_file(path("a.json"), "[1, 2");
  support::write_file(path("b.json"), R"({"generator": 3, "model": "pendulum.toml"})");
  support::write_file(path("c.json"),
                      R"({"generator": "Jourdain 0.1.0", "model": "pendulum.toml", "options": 5})");
  const support::ProcessResult result = check();
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("c.json:1:"));
}

/// A folder's name may turn the direction of text, which a terminal would obey.
TEST_F(Against, NamesOfFoldersAreMadePrintable) {
  const support::ProcessResult result = jourdain({"check", kPendulum, "--against", "no\xe2\x80\xaesuch\x1b"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("no?such?/pendulum.hpp: error: missing"));
  EXPECT_THAT(result.output, Not(HasSubstr("\x1b")));
  EXPECT_THAT(result.output, Not(HasSubstr("\xe2\x80\xae")));
}

TEST_F(Against, SeveralModelsOfOneDescriptionAreToldApartByName) {
  make({"--name", "left"});
  make({"--name", "right", "--clock"});
  const support::ProcessResult result = check();
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.output, HasSubstr("left, right; --name chooses one"));
  EXPECT_EQ(check({"--name", "right"}).status, 0);
}

TEST_F(Against, OptionsOfAnotherVersionAreSaid) {
  make({"--clock"});
  std::string text = support::read_file(path("pendulum.json"));
  text.replace(text.find("--clock"), 7, "--clack");
  support::write_file(path("pendulum.json"), text);
  const support::ProcessResult result = check();
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.output, HasSubstr("options that this version does not take"));
}

TEST(Compile, WritesARuleOfAllThatWasRead) {
  const support::TemporaryFolder folder;
  const auto in_folder = [&folder](const std::string& file) { return folder.path() + "/" + file; };
  fs::create_directory(in_folder("a $b"));
  fs::copy_file(kPendulum, in_folder("a $b/arm #1.toml"));
  support::write_file(in_folder("cell.toml"),
                      "[model]\nname = \"cell\"\n[[import]]\nfile = \"a $b/arm #1.toml\"\n");
  const support::ProcessResult result =
      support::run_process({"env", "-C", folder.path(), JOURDAIN_BINARY, "compile", "cell.toml", "-o", "out",
                            "--depfile", "cell.d"});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::string at = fs::canonical(folder.path()).string() + "/";
  EXPECT_EQ(support::read_file(in_folder("cell.d")),
            at + "out/cell.hpp \\\n  " + at + "out/cell_kernels.hpp \\\n  " + at + "out/cell.cpp \\\n  " +
                at + "out/cell.json: \\\n  " + at + "cell.toml \\\n  " + at + "a\\ $$b/arm\\ \\#1.toml\n");
}

TEST(Compile, NamesNoOptionsWhereNoneWasGiven) {
  const support::TemporaryFolder folder;
  ASSERT_EQ(jourdain({"compile", kPendulum, "-o", folder.path(), "--strict", "--name", "swing"}).status, 0);
  EXPECT_THAT(support::read_file(folder.path() + "/swing.json"), Not(HasSubstr("\"options\"")));
}

}  // namespace
}  // namespace jourdain::tests
