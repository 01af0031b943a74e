// generated/ is what the compiler emits today, on every run, whichever C++ compiler it was built by: with sanitizers
// that is another one, whose output for the other suites is compared.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "properties/random_tree.hpp"
#include "properties/to_toml.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = JOURDAIN_SOURCE_DIR;

std::vector<std::string> models() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kSource / "models"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Runs the compiler from the project's root, so that the relative path in the header is the same for everybody.
void compile(const std::string& model, const fs::path& folder) {
  const support::ProcessResult result = support::run_process(
      {"env", "-C", kSource.string(), JOURDAIN_BINARY, "compile", model, "-o", folder.string()});
  ASSERT_EQ(result.status, 0) << result.output;
}

/// The first line in which two texts differ.
std::string difference(const std::string& expected, const std::string& actual) {
  std::size_t line = 1, begin = 0;
  for (std::size_t i = 0; i < std::min(expected.size(), actual.size()) && expected[i] == actual[i]; ++i)
    if (expected[i] == '\n') {
      ++line;
      begin = i + 1;
    }
  const auto rest = [begin](const std::string& text) {
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  return fmt::format("line {}\n- {}\n+ {}", line, rest(expected), rest(actual));
}

void expect_same_folder(const fs::path& expected, const fs::path& actual) {
  for (const auto& entry : fs::directory_iterator(actual)) {
    const fs::path other = expected / entry.path().filename();
    ASSERT_TRUE(fs::exists(other)) << other.filename() << " is missing; ./dev regenerate writes it";
    const std::string was = support::read_file(other.string()),
                      is = support::read_file(entry.path().string());
    EXPECT_TRUE(was == is) << other.filename() << " differs in " << difference(was, is);
  }
}

TEST(Golden, GeneratedSourcesAreThoseOfTheModels) {
  ASSERT_FALSE(models().empty());
  for (const std::string& model : models()) {
    const fs::path committed = kSource / "generated" / model;
    if (std::getenv("JOURDAIN_UPDATE")) {
      compile("models/" + model + ".toml", committed);
      continue;
    }
#ifdef JOURDAIN_SANITIZED
    expect_same_folder(committed, fs::path(JOURDAIN_EMITTED) / model);  // by another compiler's command
#else
    const support::TemporaryFolder folder;
    compile("models/" + model + ".toml", folder.path());
    expect_same_folder(committed, folder.path());
#endif
  }
}

TEST(Determinism, TwoProcessesGiveTheSameBytes) {
  for (const std::uint64_t seed : {0u, 1u, 4u, 5u, 14u, 24u, 34u}) {
    const support::TemporaryFolder folder;
    const fs::path description = fs::path(folder.path()) / "tree.toml";
    support::write_file(description.string(), to_toml(random_tree(seed)));
    const fs::path first = fs::path(folder.path()) / "first", second = fs::path(folder.path()) / "second";
    compile(description.string(), first);
    compile(description.string(), second);
    expect_same_folder(first, second);
  }
}

/// Of accelerations, and of closing loops: the last columns of models/loops.md.
TEST(Golden, TheTableOfLoopsHasTheCountsOfTheManifests) {
  std::istringstream page(support::read_file((kSource / "models" / "loops.md").string()));
  const std::regex row("\\| `([a-z0-9_]+)` \\|.* \\| ([0-9]+) \\| ([0-9]+) \\|");
  std::size_t rows = 0;
  std::smatch parts;
  for (std::string line; std::getline(page, line);) {
    if (!std::regex_match(line, parts, row)) continue;
    const std::string name = parts[1];
    const auto operations = nlohmann::json::parse(
        support::read_file((kSource / "generated" / name / (name + ".json")).string()))["operations"];
    const char* closing = operations.contains("close_loops") ? "close_loops" : "project";
    EXPECT_EQ(operations["forward_dynamics"]["arithmetic"], std::stol(parts[2])) << line;
    EXPECT_EQ(operations[closing]["arithmetic"], std::stol(parts[3])) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 14u);
}

TEST(Golden, OmissionsSaveWhatTheManifestSays) {
  const auto saved = [](const std::string& model) {
    const auto manifest = nlohmann::json::parse(
        support::read_file((kSource / "generated" / model / (model + ".json")).string()));
    std::vector<std::string> lines = manifest["left_out"];
    return fmt::format("{}", fmt::join(lines, "\n"));
  };
  EXPECT_NE(saved("ur5").find("parent (30 operations"), std::string::npos) << saved("ur5");
  EXPECT_NE(saved("ur5").find("summed angle (113 operations"), std::string::npos) << saved("ur5");
  EXPECT_NE(saved("panda").find("parent (9 operations"), std::string::npos) << saved("panda");
  EXPECT_NE(saved("panda").find("permutations (923 operations"), std::string::npos) << saved("panda");
}

}  // namespace
}  // namespace jourdain::tests
