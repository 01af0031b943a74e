// The page of firmware: its commands run, its figures are the command's. JOURDAIN_UPDATE=1 writes the figures.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/firmware.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using commands::Target;
using nlohmann::json;

const std::string kPage = JOURDAIN_SOURCE_DIR "/templates/firmware/README.md";

/// Between two marks; fails without them.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t first = text.find(begin);
  const std::size_t last = text.find(end, first + begin.size());
  if (first == std::string::npos || last == std::string::npos) {
    ADD_FAILURE() << "no " << begin;
    return "";
  }
  return text.substr(first + begin.size(), last - first - begin.size());
}

TEST(FirmwarePage, ItsCommandsRunAndWriteWhatItSays) {
  require_tools(*commands::find_target("cortex-m4"));
  const std::string page = support::read_file(kPage);
  const support::TemporaryFolder folder;
  for (const char* shared : {"models", "templates"})
    fs::create_directory_symlink(fs::path(JOURDAIN_SOURCE_DIR) / shared, folder.path() + "/" + shared);
  fs::create_directory(folder.path() + "/bin");
  fs::create_symlink(JOURDAIN_BINARY, folder.path() + "/bin/jourdain");
  support::write_file(folder.path() + "/main.cpp", between(page, "```cpp\n", "```\n"));
  support::write_file(folder.path() + "/commands.sh",
                      "set -eu\nPATH=\"$PWD/bin:$PATH\"\n" + between(page, "```sh\n", "```\n"));
  const support::ProcessResult result =
      support::run_process({"env", "-C", folder.path(), "bash", "commands.sh"});
  EXPECT_EQ(result.status, 0) << result.output;
  const std::string written = between(page, "```text\n", "```\n");
  EXPECT_GE(written.size(), 3u);
  EXPECT_NE(result.output.find("\n" + written), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("panda in float for cortex-m4"), std::string::npos) << result.output;
  const std::string symbols = support::run_process({"arm-none-eabi-nm", folder.path() + "/panda.elf"}).output;
  EXPECT_NE(symbols.find(" sinf"), std::string::npos) << symbols;
  EXPECT_EQ(symbols.find("__aeabi_d"), std::string::npos) << symbols;
}

/// The versions that decide the figures, a line of the page.
std::string versions_line(const std::vector<json>& costs) {
  std::vector<std::string> versions;
  for (const json& cost : costs)
    for (const char* key : {"compiler", "library"})
      if (const std::string version = cost[key];
          std::find(versions.begin(), versions.end(), version) == versions.end())
        versions.push_back(version);
  return fmt::format("With {}:\n\n", fmt::join(versions, ", "));
}

/// What stands between two marks of the page becomes `text`.
void update(const std::string& mark, const std::string& text) {
  std::string page = support::read_file(kPage);
  const std::string begin = fmt::format("<!-- {} -->\n", mark);
  const std::string old = between(page, begin, fmt::format("<!-- end of {} -->", mark));
  page.replace(page.find(begin) + begin.size(), old.size(), text);
  support::write_file(kPage, page);
}

std::string stated(const std::string& mark) {
  return between(support::read_file(kPage), fmt::format("<!-- {} -->\n", mark),
                 fmt::format("<!-- end of {} -->", mark));
}

TEST(FirmwarePage, NoLibraryIsFurtherFromTheHostsThanItSays) {
  std::string table =
      fmt::format("| target, numbers | {} |\n|---|---:|---:|---:|---:|\n", fmt::join(kModels, " | "));
  std::vector<double> units;
  for (const Target& target : commands::all_targets()) {
    require_tools(target);
    table += fmt::format("| {}, {} |", target.name, motion_of("", target).real);
    for (const char* model : kModels) {
      const Motion motion = motion_of(model, target);
      double most = 0;
      for (const auto& [what, difference] :
           differences(host_motion(motion, Sines::kLibrary), target_motion(target, motion, Sines::kLibrary)))
        most = std::max(most, difference);
      units.push_back(std::ceil(most));
      table += fmt::format(" {} |", units.back());
    }
    table += "\n";
  }
  if (std::getenv("JOURDAIN_UPDATE")) return update("units", table);
  std::istringstream rows(stated("units"));
  std::vector<double> allowed;
  for (std::string cell; std::getline(rows, cell, '|');) {
    std::istringstream text(cell);
    if (double number = 0; text >> number) allowed.push_back(number);
  }
  ASSERT_EQ(allowed.size(), units.size()) << "the page has\n" << stated("units") << "but here is\n" << table;
  for (std::size_t i = 0; i < units.size(); ++i) EXPECT_LE(units[i], allowed[i]) << table;
}

TEST(FirmwarePage, ItsFiguresAreTheCommands) {
  std::vector<json> costs;
  std::string table =
      "| target, numbers | model | function | code | stack | painted | instructions |\n"
      "|---|---|---|---:|---:|---:|---:|\n";
  for (const Target& target : commands::all_targets()) {
    require_tools(target);
    for (const char* model : {"pendulum", "panda", "squeezer"}) {
      costs.push_back(target_cost(model, target));
      for (const json& entry : costs.back()["functions"])
        if (entry["name"] == "forward_dynamics" || entry["name"] == "rk4_step")
          table += fmt::format("| {}, {} | {} | `{}` | {} | {} | {} | {} |\n", target.name,
                               std::string(costs.back()["number_type"]), model, std::string(entry["name"]),
                               entry["code_bytes"].get<long>(), entry["stack_bytes"].get<long>(),
                               entry["painted_stack_bytes"].get<long>(), entry["instructions"].get<long>());
    }
  }
  const std::string versions = versions_line(costs);
  if (std::getenv("JOURDAIN_UPDATE")) return update("figures", versions + table);
  const std::string figures = stated("figures");
  if (!figures.starts_with(versions))
    GTEST_SKIP() << "the page's figures are of other tools than here: " << versions;
  EXPECT_EQ(figures, versions + table) << "write them with JOURDAIN_UPDATE=1";
}

}  // namespace
}  // namespace jourdain::tests
