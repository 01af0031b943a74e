// Data flows in one direction: a file includes its own layer or lower ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = JOURDAIN_SOURCE_DIR;
constexpr std::size_t kLongestFile = 400;

std::vector<fs::path> sources(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".cpp" || extension == ".hpp" || extension == ".h") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Paths in the #include lines of a file.
std::vector<std::string> includes(const fs::path& file) {
  std::vector<std::string> found;
  std::istringstream text(support::read_file(file.string()));
  for (std::string row; std::getline(text, row);) {
    const std::size_t open = row.find_first_of("<\"");
    if (!row.starts_with("#include") || open == std::string::npos) continue;
    const std::size_t close = row.find_first_of(">\"", open + 1);
    found.push_back(row.substr(open + 1, close - open - 1));
  }
  return found;
}

std::string first_folder(const std::string& path) {
  const std::size_t slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// The rooms of the generator, and what each may include beside itself: the way of a description to its files.
const std::map<std::string, std::set<std::string>>& rooms() {
  static const std::map<std::string, std::set<std::string>> table = [] {
    std::map<std::string, std::set<std::string>> rooms = {
        {"support", {}},
        {"model", {"support"}},
        {"model/check", {"model", "support"}},
        {"model/read", {"model/check", "model", "support"}},
        {"kinematics", {"model", "support"}},
        {"dynamics", {"kinematics", "model", "support"}},
        {"ir", {"support"}},
        {"passes", {"ir", "support"}},
        {"lowering", {"passes", "ir", "dynamics", "kinematics", "model", "support"}},
        {"readback", {"ir", "support"}},
    };
    // Each may include all that may stand below it.
    std::set<std::string> below = {"support", "model",  "kinematics", "dynamics",
                                   "ir",      "passes", "lowering",   "reference"};
    for (const char* room :
         {"loops/record", "loops/rows", "loops/intervals", "loops/closed_form", "loops/regularity",
          "loops/plan", "loops/treatments", "programs", "validate", "validate/loops"}) {
      rooms[room] = below;
      below.insert(room);
    }
    rooms["emit"] = {"programs", "loops/record", "passes", "ir", "model", "support"};
    rooms["emit/cpp"] = {"emit", "programs", "loops/record", "passes", "ir", "model", "support"};
    rooms["emit/c"] = rooms["emit/cpp"];
    below.insert({"emit", "readback"});
    rooms["compile"] = below;
    rooms["compile"].insert({"emit/cpp", "emit/c"});  // the one place that chooses a language
    rooms["report"] = {"studies", "emit", "model", "support"};
    below.insert({"compile", "report", "studies", "jourdain", "model/read", "model/check"});
    rooms["commands"] = below;
    return rooms;
  }();
  return table;
}

/// The room of a path as it is included; empty: the standard library's, a package's.
std::string room_of(const std::string& include) {
  const std::string folder = fs::path(include).parent_path().string();
  if (rooms().count(folder) || folder == "reference" || folder == "studies" || folder == "jourdain")
    return folder;
  return "";
}

TEST(Layering, GeneratorLayersNeverReachUp) {
  for (const fs::path& file : sources("generator")) {
    const std::string place = fs::relative(file, kSource / "generator").string();
    if (place == "main.cpp") continue;
    const std::string room = room_of(place);
    ASSERT_FALSE(room.empty()) << place << " lies in no room";
    for (const std::string& include : includes(file)) {
      const std::string target = room_of(include);
      const bool is_ours = fs::exists(kSource / "generator" / include) ||
                           fs::exists(kSource / "runtime" / include) ||
                           fs::exists(file.parent_path() / include);
      const bool is_made = include == "emit/template_table.hpp";  // by CMake, from templates/
      EXPECT_EQ(is_ours || is_made, !target.empty())
          << place << " includes " << include << ", which no room holds";
      EXPECT_TRUE(target.empty() || target == room || rooms().at(room).count(target))
          << place << " includes " << include;
    }
  }
}

TEST(Layering, NoTwoHeadersHaveOneName) {
  std::map<std::string, fs::path> places;
  for (const char* folder : {"generator", "runtime"})
    for (const fs::path& file : sources(folder)) {
      if (file.extension() == ".cpp") continue;
      const auto [place, is_new] = places.emplace(file.filename().string(), file);
      EXPECT_TRUE(is_new) << fs::relative(file, kSource) << " and " << fs::relative(place->second, kSource);
    }
}

/// Who computes in many digits.
bool uses_long_numbers(const std::string& layer) {
  return layer == "support" || layer == "ir" || layer == "readback" || layer == "loops" ||
         layer == "validate";
}

TEST(Layering, GinacStaysInDerivationAndItsBridge) {
  for (const fs::path& file : sources("generator")) {
    const std::string layer = first_folder(fs::relative(file, kSource / "generator").string());
    const bool derivation = layer == "kinematics" || layer == "dynamics" || layer == "lowering";
    for (const std::string& include : includes(file)) {
      const bool is_numbers = first_folder(include) == "cln" && uses_long_numbers(layer);
      EXPECT_TRUE(derivation || is_numbers ||
                  (first_folder(include) != "ginac" && first_folder(include) != "cln"))
          << fs::relative(file, kSource) << " includes " << include;
    }
  }
}

TEST(Layering, RuntimeKnowsOnlyTheModel) {
  const std::set<std::string> allowed = {
      "reference", "studies", "jourdain", "model",   "support",   "Eigen",     "unsupported",  "fmt",
      "nlohmann",  "cln",     "cvode",    "nvector", "sunlinsol", "sunmatrix", "sunnonlinsol", ""};
  const std::set<std::string> of_devices = {"hip", "cuda_runtime.h"};
  for (const fs::path& file : sources("runtime"))
    for (const std::string& include : includes(file))
      EXPECT_TRUE(allowed.count(first_folder(include)) ||
                  (file.filename() == "device.hpp" && of_devices.count(first_folder(include))))
          << fs::relative(file, kSource) << " includes " << include;
}

TEST(Layering, TheReaderOfFinishedTextSharesNothingWithItsWriter) {
  for (const fs::path& file : sources("generator/readback"))
    for (const std::string& include : includes(file)) {
      const std::string target = first_folder(include);
      EXPECT_TRUE(target == "readback" || include == "ir/program.hpp" || include == "ir/module.hpp" ||
                  include == "ir/text_choices.hpp" || include == "support/files.hpp" ||
                  include == "support/called_function.hpp" || include == "support/elementary_functions.hpp" ||
                  target == "fmt" || target == "cln" || target == "nlohmann" || target.empty())
          << fs::relative(file, kSource) << " includes " << include;
    }
}

TEST(Layering, StudiesNameNoModel) {
  for (const auto& model : fs::directory_iterator(kSource / "models")) {
    if (model.path().extension() != ".toml") continue;
    for (const fs::path& file : sources("runtime/studies"))
      EXPECT_EQ(support::read_file(file.string()).find(model.path().stem().string()), std::string::npos)
          << fs::relative(file, kSource) << " names " << model.path().stem();
  }
}

/// Paths of files between backticks: from the page, from its parent, the generator or the top; NAME stands for any.
TEST(Pages, NameFilesThatExist) {
  for (const char* page : {"generator/README.md", "generator/loops/README.md", "runtime/README.md",
                           "models/README.md", "templates/README.md"}) {
    const std::string text = support::read_file((kSource / page).string());
    const fs::path folder = (kSource / page).parent_path();
    std::size_t found = 0;
    for (std::size_t open = text.find('`'); open != std::string::npos;) {
      const std::size_t close = text.find('`', open + 1);
      if (close == std::string::npos) break;
      const std::string name = text.substr(open + 1, close - open - 1);
      open = text.find('`', close + 1);
      const std::string extension = fs::path(name).extension().string();
      if ((extension != ".cpp" && extension != ".hpp" && extension != ".h") ||
          name.find("NAME") != std::string::npos)
        continue;
      ++found;
      const auto exists = [&name](const fs::path& place) { return fs::exists(place / name); };
      EXPECT_TRUE(exists(folder) || exists(folder.parent_path()) || exists(kSource) ||
                  exists(kSource / "generator"))
          << page << " names " << name;
    }
    EXPECT_TRUE(found > 0 || std::string(page).starts_with("models")) << page;
  }
}

TEST(Layering, FilesHoldOneIdea) {
  for (const char* folder : {"generator", "runtime"})
    for (const fs::path& file : sources(folder)) {
      const std::string text = support::read_file(file.string());
      EXPECT_LE(std::size_t(std::count(text.begin(), text.end(), '\n')), kLongestFile)
          << fs::relative(file, kSource);
    }
}

/// clang-format sees to code.
TEST(Layering, CommentsHaveAtMost120Columns) {
  constexpr std::ptrdiff_t kColumns = 120;
  const auto is_first_byte = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  for (const char* folder : {"generator", "runtime", "tests"})
    for (const fs::path& file : sources(folder)) {
      std::istringstream text(support::read_file(file.string()));
      for (std::string row; std::getline(text, row);) {
        if (row.find("//") != row.find_first_not_of(' ')) continue;
        EXPECT_LE(std::count_if(row.begin(), row.end(), is_first_byte), kColumns)
            << fs::relative(file, kSource) << ": " << row;
      }
    }
}

TEST(Layering, TemplatesUseMathAlone) {
  const std::set<std::string> of_commands = {"shim.cpp.in", "bench.cpp.in", "bench_processor.hpp.in",
                                             "ensemble.cpp.in"};  // never in anyone's program
  for (const auto& entry : fs::directory_iterator(kSource / "templates")) {
    if (of_commands.count(entry.path().filename().string()) || !entry.is_regular_file()) continue;
    for (const std::string& include : includes(entry.path()))
      EXPECT_TRUE(include == "math.h" || include == "jourdain_interface.h" || include.find('@') == 0)
          << entry.path().filename() << " includes " << include;
  }
}

TEST(Layering, TopLevelHoldsTheAgreedFolders) {
  const std::set<std::string> agreed = {
      "CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE",   "dev",  "generator",
      "runtime",        "templates",         "models",    "generated", "tests"};
  // Of the files that are kept: reports and trajectories that a user has made lie beside them.
  const support::ProcessResult kept = support::run_process({"git", "-C", kSource.string(), "ls-files"});
  ASSERT_EQ(kept.status, 0) << "no git checkout: " << kept.output;
  std::istringstream paths(kept.output);
  int files = 0;
  for (std::string path; std::getline(paths, path); ++files) {
    const std::string name = path.substr(0, path.find('/'));
    EXPECT_TRUE(name[0] == '.' || agreed.count(name)) << path;
  }
  EXPECT_GT(files, 100);
}

}  // namespace
}  // namespace jourdain::tests
