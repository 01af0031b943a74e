// The list of what the build with sanitizers leaves out names suites and tests that exist.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>

#include "support/files.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kTests = fs::path(JOURDAIN_SOURCE_DIR) / "tests";

/// Names as `Suite.Test`, of those without parameters.
std::set<std::string> all_tests() {
  std::set<std::string> found;
  for (const fs::directory_entry& file : fs::recursive_directory_iterator(kTests)) {
    if (!file.path().filename().string().ends_with("_test.cpp")) continue;
    std::istringstream text(support::read_file(file.path().string()));
    for (std::string line; std::getline(text, line);) {
      const std::size_t open = line.find('('), comma = line.find(", "), close = line.find(')');
      if (!line.starts_with("TEST") || comma > close || close == std::string::npos) continue;
      found.insert(line.substr(open + 1, comma - open - 1) + "." + line.substr(comma + 2, close - comma - 2));
    }
  }
  return found;
}

/// `*` stands for any letters.
bool matches(const std::string& pattern, const std::string& name) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] != '*')
    return !name.empty() && name[0] == pattern[0] && matches(pattern.substr(1), name.substr(1));
  return matches(pattern.substr(1), name) || (!name.empty() && matches(pattern, name.substr(1)));
}

TEST(LeftOut, NamesSuitesAndTestsThatExist) {
  const std::set<std::string> names = all_tests();
  ASSERT_GT(names.size(), 500u);
  std::istringstream list(support::read_file((kTests / "left_out_sanitized.txt").string()));
  int patterns = 0, suites = 0;
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] >= 'a' && line[0] <= 'z') {
      ++suites;
      EXPECT_TRUE(fs::is_directory(kTests / line)) << line;
      continue;
    }
    ++patterns;
    int named = 0;
    for (const std::string& name : names) named += matches(line, name);
    EXPECT_GE(named, 1) << line;
  }
  EXPECT_GE(patterns, 20);
  EXPECT_GE(suites, 5);
}

}  // namespace
}  // namespace jourdain::tests
