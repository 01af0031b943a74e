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

TEST(Layering, GeneratorLayersNeverReachUp) {
  const std::map<std::string, std::set<std::string>> allowed = {
      {"support", {"support"}},
      {"model", {"model", "support"}},
      {"kinematics", {"kinematics", "model", "support"}},
      {"dynamics", {"dynamics", "kinematics", "model", "support"}},
      {"ir", {"ir", "support"}},
      {"passes", {"passes", "ir", "support"}},
      {"loops",
       {"loops", "validate", "dynamics", "kinematics", "passes", "ir", "model", "support", "reference"}},
      {"emit", {"emit", "passes", "ir", "support", "model"}},
      {"readback", {"readback", "ir", "support"}},
      {"validate", {"validate", "dynamics", "kinematics", "ir", "model", "support", "reference"}},
  };
  std::set<std::string> ours = {"commands", "studies"};
  for (const auto& [layer, lower] : allowed) ours.insert(layer);
  for (const auto& [layer, lower] : allowed)
    for (const fs::path& file : sources(fs::path("generator") / layer))
      for (const std::string& include : includes(file)) {
        const std::string target = first_folder(include);
        const bool bridge = layer == "ir" && file.stem() == "lower" && target == "kinematics";
        EXPECT_TRUE(lower.count(target) || bridge || !ours.count(target))
            << fs::relative(file, kSource) << " includes " << include;
      }
}

/// Who computes in many digits.
bool uses_long_numbers(const std::string& layer) {
  return layer == "support" || layer == "ir" || layer == "readback" || layer == "loops";
}

TEST(Layering, GinacStaysInDerivationAndItsBridge) {
  for (const fs::path& file : sources("generator")) {
    const std::string layer = first_folder(fs::relative(file, kSource / "generator").string());
    const bool derivation =
        layer == "kinematics" || layer == "dynamics" || (layer == "ir" && file.stem() == "lower");
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
  for (const fs::path& file : sources("runtime"))
    for (const std::string& include : includes(file))
      EXPECT_TRUE(allowed.count(first_folder(include)))
          << fs::relative(file, kSource) << " includes " << include;
}

TEST(Layering, TheReaderOfFinishedTextSharesNothingWithItsWriter) {
  for (const fs::path& file : sources("generator/readback"))
    for (const std::string& include : includes(file)) {
      const std::string target = first_folder(include);
      EXPECT_TRUE(target == "readback" || include == "ir/program.hpp" || include == "ir/module.hpp" ||
                  include == "support/files.hpp" || target == "fmt" || target == "cln" ||
                  target == "nlohmann" || target.empty())
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

TEST(Layering, FilesHoldOneIdea) {
  for (const char* folder : {"generator", "runtime"})
    for (const fs::path& file : sources(folder)) {
      const std::string text = support::read_file(file.string());
      EXPECT_LE(std::size_t(std::count(text.begin(), text.end(), '\n')), kLongestFile)
          << fs::relative(file, kSource);
    }
}

TEST(Layering, TemplatesUseMathAlone) {
  for (const auto& entry : fs::directory_iterator(kSource / "templates")) {
    if (entry.path().filename() == "shim.cpp.in") continue;
    for (const std::string& include : includes(entry.path()))
      EXPECT_TRUE(include == "math.h" || include.find('@') == 0)
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
