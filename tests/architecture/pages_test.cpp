// Pages lead somewhere: links and pictures exist, and the front page is short and says what it holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = JOURDAIN_SOURCE_DIR;

/// Pages of the repository, those included that are not yet committed.
std::vector<std::string> pages() {
  const support::ProcessResult listed =
      support::run_process({"git", "-C", kSource.string(), "ls-files", "--cached", "--others",
                            "--exclude-standard", "--deduplicate", "*.md"});
  EXPECT_EQ(listed.status, 0) << "no git checkout: " << listed.output;
  std::vector<std::string> found;
  std::istringstream lines(listed.output);
  for (std::string page; std::getline(lines, page);) found.push_back(page);
  return found;
}

std::string read_page(const fs::path& page) { return support::read_file((kSource / page).string()); }

/// A page without code: brackets are no links there. Lists continue with fewer than four blanks.
std::string prose(const std::string& text) {
  std::string found;
  bool is_fenced = false, is_code = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) is_fenced = !is_fenced;
    if (is_fenced || line.starts_with("```") || line.starts_with("    ")) continue;
    for (const char c : line + "\n") {
      if (c == '`') is_code = !is_code;
      if (!is_code) found += c;
    }
  }
  return found;
}

/// What the brackets of links and pictures hold.
std::vector<std::string> targets(const std::string& text) {
  std::vector<std::string> found;
  for (std::size_t open = text.find("]("); open != std::string::npos; open = text.find("](", open + 2))
    found.push_back(text.substr(open + 2, text.find(')', open) - open - 2));
  return found;
}

/// Headings of a level, as they stand.
std::vector<std::string> headings(const std::string& text, const std::string& mark) {
  std::vector<std::string> found;
  bool is_fenced = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) is_fenced = !is_fenced;
    if (!is_fenced && line.starts_with(mark + " ")) found.push_back(line.substr(mark.size() + 1));
  }
  return found;
}

/// The name of a heading in addresses, as GitHub makes it of a heading in ASCII.
std::string anchor(const std::string& heading) {
  std::string name;
  for (const char c : heading) {
    const auto letter = static_cast<unsigned char>(c);
    if (c == ' ') name += '-';
    if (std::isalnum(letter) || c == '-' || c == '_') name += static_cast<char>(std::tolower(letter));
  }
  return name;
}

bool has_anchor(const std::string& text, const std::string& name) {
  for (const char* mark : {"#", "##", "###"})
    for (const std::string& heading : headings(text, mark))
      if (anchor(heading) == name) return true;
  return false;
}

TEST(Pages, LinksAndPicturesExist) {
  int links = 0;
  for (const std::string& page : pages()) {
    const std::string text = read_page(page);
    for (const std::string& target : targets(prose(text))) {
      if (target.find("://") != std::string::npos) continue;
      ++links;
      const std::size_t hash = target.find('#');
      const std::string path = target.substr(0, hash);
      const fs::path place = path.empty() ? fs::path(page) : fs::path(page).parent_path() / path;
      EXPECT_FALSE(path.starts_with("/")) << page << " links to " << target;
      const bool is_there = fs::exists(kSource / place);
      EXPECT_TRUE(is_there) << page << " links to " << target;
      if (is_there && hash != std::string::npos) {
        EXPECT_TRUE(has_anchor(read_page(place), target.substr(hash + 1))) << page << " links to " << target;
      }
    }
  }
  EXPECT_GT(links, 20);
}

TEST(Pages, TheFrontIsShortAndListsItsSections) {
  constexpr std::ptrdiff_t kLines = 250;
  const std::string text = read_page("README.md");
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), kLines);
  const std::vector<std::string> sections = headings(text, "##");
  EXPECT_FALSE(sections.empty());
  const std::string front = text.substr(0, text.find("\n## "));
  for (const std::string& section : sections)
    EXPECT_NE(front.find("[" + section + "](#" + anchor(section) + ")"), std::string::npos)
        << "no line of the contents leads to '" << section << "'";
}

}  // namespace
}  // namespace jourdain::tests
