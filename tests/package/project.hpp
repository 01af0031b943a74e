// An installation in a temporary folder, and projects that use it.
#pragma once

#include <string>
#include <vector>

#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {

/// Where the command lies that the tests are about, and the rest of what is built.
std::string build_folder();

/// What `cmake --install` puts into a folder, once for all tests.
const std::string& installation();

/// Where the command lies for who uses it: as installed, but for the build with sanitizers, which is not.
std::string command_folder();

/// Runs a script with `sh -e` in a folder. `settings` are variables of the environment, "NAME=VALUE".
support::ProcessResult run_script(const std::string& folder, const std::string& script,
                                  const std::vector<std::string>& settings = {});

/// A folder with a project whose CMakeLists.txt ends with `lines`, after find_package(jourdain).
class Project {
 public:
  explicit Project(const std::string& lines, const std::string& languages = "CXX",
                   const std::string& package = "REQUIRED");

  const std::string& folder() const { return folder_.path(); }
  void write(const std::string& file, const std::string& text) const;
  support::ProcessResult configure(const std::vector<std::string>& options = {},
                                   const std::string& generator = "Ninja") const;
  support::ProcessResult build() const;

 private:
  support::TemporaryFolder folder_;
};

}  // namespace jourdain::tests
