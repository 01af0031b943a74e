// The fuzzer's sample of every test run, and that it sees what it is to see.
#include <gtest/gtest.h>

#include <filesystem>

#include "fuzz/random_urdf.hpp"
#include "fuzz/tally.hpp"
#include "fuzz/toml_mutation.hpp"
#include "model/read/read.hpp"
#include "properties/effort.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

TEST(Fuzz, EveryCaseEndsAsItMay) {
  // Each is a run of the whole command: fewer than of other random tests.
  const std::string count = std::to_string(draws_all_cases() ? 10000 : cases(2800));
  const support::ProcessResult run = support::run_process({JOURDAIN_FUZZ, "--seed", "1", "--cases", count});
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_NE(run.output.find(count + " cases: "), std::string::npos) << run.output;
}

/// A folder with an empty one for the case and one for temporary files.
class Judged : public testing::Test {
 protected:
  Judged() {
    for (const char* part : {"/case", "/tmp"}) std::filesystem::create_directories(folder_.path() + part);
  }
  Outcome outcome(int status, const std::string& errors, CaseKind kind = CaseKind::kToml,
                  bool valid = false) {
    ChildResult result;
    result.status = status;
    result.errors = errors;
    return judge({kind, {"compile"}, {}, valid, ""}, result, folder_.path()).outcome;
  }

  support::TemporaryFolder folder_;
};

TEST_F(Judged, ARefusalNamesThePlace) {
  EXPECT_EQ(outcome(1, "model.toml:3:1: error: no\n"), Outcome::kRefused);
  EXPECT_EQ(outcome(1, "note: x\nmodel.urdf:3:12: error: no\n"), Outcome::kRefused);
  EXPECT_EQ(outcome(1, "model.toml: error: no\n"), Outcome::kUnplaced);
  EXPECT_EQ(outcome(1, "model.toml:3:1: warning: no\nerror: no\n"), Outcome::kUnplaced);
  EXPECT_EQ(outcome(1, ""), Outcome::kUnplaced);
  EXPECT_EQ(outcome(1, "model.toml: error: the file is empty\n"), Outcome::kRefusedWhole);
}

TEST_F(Judged, WhatIsValidIsTaken) {
  EXPECT_EQ(outcome(1, "model.toml:3:1: error: no\n", CaseKind::kValid, true), Outcome::kValidRefused);
}

TEST_F(Judged, OnlyACommandLineIsAUsageError) {
  EXPECT_EQ(outcome(2, "error: no\n", CaseKind::kOptions), Outcome::kUsage);
  EXPECT_EQ(outcome(2, "error: no\n"), Outcome::kInternal);
  EXPECT_EQ(outcome(2, "", CaseKind::kOptions), Outcome::kUntidy);
  EXPECT_EQ(outcome(2, "error: '\x1b'\n", CaseKind::kOptions), Outcome::kUntidy);
}

TEST_F(Judged, FaultsOfOurs) {
  EXPECT_EQ(outcome(70, "internal error: x\n"), Outcome::kInternal);
  EXPECT_EQ(outcome(70, "internal error: x\n", CaseKind::kOptions), Outcome::kInternal);
  EXPECT_EQ(outcome(128 + 11, ""), Outcome::kSignal);
  EXPECT_EQ(outcome(99, "==1==ERROR: AddressSanitizer\n"), Outcome::kSignal);
}

TEST_F(Judged, NothingIsLeftBehind) {
  support::write_file(folder_.path() + "/tmp/x", "x");
  EXPECT_EQ(outcome(1, "model.toml:3:1: error: no\n"), Outcome::kUntidy);
}

TEST_F(Judged, WhatIsEmittedIsThereAndWasReadBack) {
  std::filesystem::create_directories(folder_.path() + "/case/out");
  for (const char* name : {"m.hpp", "m_kernels.hpp", "m.cpp"})
    support::write_file(folder_.path() + "/case/out/" + name, "x");
  const auto outcome_with = [&](const std::string& manifest, const std::string& output) {
    support::write_file(folder_.path() + "/case/out/m.json", manifest);
    ChildResult result;
    result.output = output;
    return judge({CaseKind::kToml, {"compile"}, {}, false, ""}, result, folder_.path()).outcome;
  };
  EXPECT_EQ(outcome_with("{}", "read back from the files: 9"), Outcome::kDone);
  EXPECT_EQ(outcome_with("{}", ""), Outcome::kUntidy);
  EXPECT_EQ(outcome_with("{\"condition\": inf}", "read back from the files: 9"), Outcome::kUntidy);
}

TEST(Cases, FollowFromSeedAndNumberAlone) {
  for (std::uint64_t index = 0; index < 40; ++index) {
    const Case once = make_case(7, index), again = make_case(7, index);
    EXPECT_EQ(once.arguments, again.arguments);
    ASSERT_EQ(once.files.size(), again.files.size());
    for (std::size_t i = 0; i < once.files.size(); ++i) EXPECT_EQ(once.files[i].text, again.files[i].text);
  }
}

TEST(Cases, ATreeThatIsPrintedSaysWhatWasRead) {
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(JOURDAIN_SOURCE_DIR) + "/models")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string printed = print_tree(read_tree(support::read_file(entry.path().string())));
    EXPECT_EQ(print_tree(read_tree(printed)), printed);
    support::Diagnostics diagnostics(entry.path().string(), printed);
    EXPECT_TRUE(model::read_mechanism(diagnostics)) << diagnostics.format();
  }
}

TEST(Cases, RandomRobotsAreValid) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    support::Diagnostics diagnostics("model.urdf", random_urdf(random));
    EXPECT_TRUE(model::read_mechanism(diagnostics)) << diagnostics.format();
  }
}

}  // namespace
}  // namespace jourdain::tests
