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

#include "commands/tool.hpp"
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

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t place = 0; (place = text.find(from, place)) != std::string::npos; place += to.size())
    text.replace(place, from.size(), to);
  return text;
}

/// What the page shows of a language: commands, and the program that they compile.
struct Shown {
  std::string heading;  ///< its place on the page: behind this
  std::string block;    ///< kind of the program's listing
  std::string program;  ///< its file
};

const Shown kCpp = {"# Firmware\n", "```cpp\n", "main.cpp"}, kC = {"The same in C99", "```c\n", "main.c"};

/// Runs commands of the page in `folder`, with the changes that make them another model's.
std::string run_page(const std::string& folder, const Shown& shown,
                     const std::vector<std::pair<std::string, std::string>>& changes) {
  std::string page = support::read_file(kPage);
  page = page.substr(page.find(shown.heading));
  for (const auto& [from, to] : changes) page = replaced(page, from, to);
  for (const char* shared : {"models", "templates"})
    fs::create_directory_symlink(fs::path(JOURDAIN_SOURCE_DIR) / shared, fs::path(folder) / shared);
  fs::create_directory(folder + "/bin");
  fs::create_symlink(JOURDAIN_BINARY, folder + "/bin/jourdain");
  support::write_file(folder + "/" + shown.program, between(page, shown.block, "```\n"));
  support::write_file(folder + "/commands.sh",
                      "set -eu\nPATH=\"$PWD/bin:$PATH\"\n" + between(page, "```sh\n", "```\n"));
  return commands::run_tool({"env", "-C", folder, "bash", "commands.sh"});
}

/// What the same program writes on the host, with the model's text in `source`.
std::string written_on_host(const std::string& folder, const Shown& shown, const std::string& source) {
  const std::string include = "-I" JOURDAIN_SOURCE_DIR "/templates/firmware";
  const std::string compiler = shown.program == "main.c" ? "gcc" : "g++";
  commands::run_tool({"gcc", "-c", include, JOURDAIN_SOURCE_DIR "/tests/firmware/programs/host_board.c", "-o",
                      folder + "/host_board.o"});
  commands::run_tool({compiler, "-O2", "-ffp-contract=off", include,
                      "-I" + fs::path(folder + "/" + source).parent_path().string(),
                      folder + "/" + shown.program, folder + "/" + source, folder + "/host_board.o", "-lm",
                      "-o", folder + "/host"});
  return commands::run_tool({folder + "/host"});
}

void expect_neither_double_nor_library(const std::string& image) {
  const std::string symbols = commands::run_tool({"arm-none-eabi-nm", image});
  for (const char* name : {" sinf", " cosf", " atan2f", "sqrtf", "__aeabi_d"})
    EXPECT_EQ(symbols.find(name), std::string::npos) << symbols;
}

class FirmwarePage : public testing::Test {
 protected:
  void SetUp() override {
    for (const Target& target : commands::all_targets()) require_tools(target);
  }
};

TEST_F(FirmwarePage, ItsCommandsWriteWhatItSaysAsTheHostDoes) {
  const std::string written = between(support::read_file(kPage), "```text\n", "```\n");
  for (const Shown& shown : {kCpp, kC}) {
    const support::TemporaryFolder folder;
    const std::string output = run_page(folder.path(), shown, {});
    EXPECT_NE(output.find("\n" + written), std::string::npos) << output;
    const std::string source = shown.program == "main.c" ? "panda/panda_f.c" : "panda/panda.cpp";
    EXPECT_EQ(written_on_host(folder.path(), shown, source), written);
    expect_neither_double_nor_library(folder.path() + "/panda.elf");
    if (shown.program == "main.cpp") {
      EXPECT_NE(output.find("panda in float for cortex-m4"), std::string::npos) << output;
    }
  }
}

TEST_F(FirmwarePage, ItsCommandsServeTheSqueezer) {
  std::vector<std::string> both;
  for (const Shown& shown : {kCpp, kC}) {
    const support::TemporaryFolder folder;
    const std::string output =
        run_page(folder.path(), shown,
                 {{"panda", "squeezer"}, {"y_joint4", "y_beta"}, {"1e-3f", "1e-4f"}, {"{{0}}", "{0}"}});
    const std::string source = shown.program == "main.c" ? "squeezer/squeezer_f.c" : "squeezer/squeezer.cpp";
    both.push_back(written_on_host(folder.path(), shown, source));
    EXPECT_GT(std::atoi(both.back().c_str()), 1000) << both.back();  // it turns
    EXPECT_NE(output.find("\n" + both.back()), std::string::npos) << both.back() << output;
    expect_neither_double_nor_library(folder.path() + "/squeezer.elf");
  }
  EXPECT_EQ(both[0], both[1]);
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

TEST_F(FirmwarePage, NoLibraryIsFurtherFromTheHostsThanItSays) {
  std::string table =
      fmt::format("| target, numbers | {} |\n|---|---:|---:|---:|---:|\n", fmt::join(kModels, " | "));
  std::vector<double> units;
  for (const Target& target : commands::all_targets()) {
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

TEST_F(FirmwarePage, ItsTargetsAreTheCommands) {
  const std::string page = support::read_file(kPage);
  for (const Target& target : commands::all_targets()) {
    const std::string row = fmt::format("| {} | `{}g++ {}` | `{}` |\n", target.name, target.tools,
                                        fmt::join(target.options, " "), fmt::join(target.machine, " "));
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST_F(FirmwarePage, ItsFiguresAreTheCommands) {
  std::vector<json> costs;
  std::string table =
      "| target, numbers | model | function | code | stack | painted | instructions |\n"
      "|---|---|---|---:|---:|---:|---:|\n";
  for (const Target& target : commands::all_targets()) {
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
