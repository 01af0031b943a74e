// One case per message: cases/NAME.toml or NAME.urdf, and NAME.expected with the exact text a user sees. What cases
// import stands in cases/parts. Reader options may stand in a comment on the first line ("# options: --lock elbow").
// With JOURDAIN_UPDATE=1 in the environment the expected files are rewritten.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "loops/plan/plan.hpp"
#include "model/read/read.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"

namespace jourdain::model {
namespace {

const std::filesystem::path kCases = std::filesystem::path(JOURDAIN_SOURCE_DIR) / "tests/diagnostics/cases";

ReadOptions options_in(const std::string& text) {
  ReadOptions options;
  const std::string first_line = text.substr(0, text.find('\n'));
  const std::string mark = "options: ";
  const auto begin = first_line.find(mark);
  if (begin == std::string::npos) return options;
  std::istringstream words(first_line.substr(begin + mark.size()));
  for (std::string word; words >> word;) {
    if (word == "--no-snap") options.snap = 0;
    if (word == "--no-damping") options.damping = false;
    if (word == "--friction") options.friction = true;
    if (word == "--external") options.external = true;  // as compile and check read
    if (word == "--no-mimic") options.mimic = false;
    if (word == "--lock") options.locked_joints.emplace_back(words >> word ? word : "");
    if (word == "--root")
      options.root = (words >> word, word == "free") ? RootJoint::kFree : RootJoint::kFixed;
  }
  return options;
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kCases))
    if (entry.is_regular_file() && entry.path().extension() != ".expected")
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

class DiagnosticCase : public testing::TestWithParam<std::string> {};

TEST_P(DiagnosticCase, ShowsTheExpectedText) {
  const std::string text = support::read_file((kCases / GetParam()).string());
  std::filesystem::current_path(kCases);
  support::Diagnostics diagnostics(GetParam(), text);
  const std::optional<Mechanism> mechanism = read_mechanism(diagnostics, options_in(text));
  EXPECT_EQ(mechanism.has_value(), !diagnostics.has_errors());
  if (mechanism) loops::plan_loops(*mechanism, diagnostics);
  const std::string shown = diagnostics.format();

  const std::string expected = (kCases / GetParam()).replace_extension(".expected").string();
  if (const char* update = std::getenv("JOURDAIN_UPDATE"); update && std::string(update) == "1")
    support::write_file(expected, shown);
  EXPECT_EQ(shown, support::read_file(expected));
}

INSTANTIATE_TEST_SUITE_P(Cases, DiagnosticCase, testing::ValuesIn(case_names()), [](const auto& given) {
  std::string name = given.param;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

}  // namespace
}  // namespace jourdain::model
