// Running another program and keeping what it prints.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "support/interruption.hpp"

namespace jourdain::support {

struct ProcessResult {
  int status = 0;      ///< exit status; 128 + signal where a signal ended it
  std::string output;  ///< stdout and stderr together
};

/// Runs `command[0]`, found on the PATH, with the other entries as arguments and no shell between. Throws
/// EnvironmentError when it cannot be started.
ProcessResult run_process(const std::vector<std::string>& command);

/// A fresh folder under the system's temporary one, removed with its contents at the end of its life
/// or when the program is interrupted.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::unique_ptr<RemovedOnInterruption> removed_;
};

}  // namespace jourdain::support
