#include "package/project.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "support/check.hpp"
#include "support/files.hpp"

namespace jourdain::tests {

std::string build_folder() { return std::filesystem::path(JOURDAIN_BINARY).parent_path().string(); }

const std::string& installation() {
  static const support::TemporaryFolder folder;
  static const bool done = [] {
    const auto result =
        support::run_process({"cmake", "--install", build_folder(), "--prefix", folder.path()});
    if (result.status != 0) throw support::EnvironmentError(result.output);
    return true;
  }();
  (void)done;
  return folder.path();
}

std::string command_folder() {
#ifdef JOURDAIN_SANITIZED
  return build_folder();
#else
  return installation() + "/bin";
#endif
}

support::ProcessResult run_script(const std::string& folder, const std::string& script,
                                  const std::vector<std::string>& settings) {
  std::vector<std::string> command = {"env", "-C", folder};
  command.insert(command.end(), settings.begin(), settings.end());
  command.insert(command.end(), {"sh", "-e", "-c", script});
  return support::run_process(command);
}

Project::Project(const std::string& lines, const std::string& languages, const std::string& package) {
  write("CMakeLists.txt", fmt::format("cmake_minimum_required(VERSION 3.20)\nproject(test LANGUAGES {})\n"
                                      "find_package(jourdain {})\n{}\n",
                                      languages, package, lines));
}

void Project::write(const std::string& file, const std::string& text) const {
  support::write_file(folder() + "/" + file, text);
}

support::ProcessResult Project::configure(const std::vector<std::string>& options,
                                          const std::string& generator) const {
  std::vector<std::string> command = {
      "cmake",  "-G", generator,           "-S",
      folder(), "-B", folder() + "/build", "-DCMAKE_PREFIX_PATH=" + installation()};
  command.insert(command.end(), options.begin(), options.end());
  return support::run_process(command);
}

support::ProcessResult Project::build() const {
  return support::run_process({"cmake", "--build", folder() + "/build"});
}

}  // namespace jourdain::tests
