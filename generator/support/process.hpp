// Running another program and keeping what it prints.
#pragma once

#include <string>
#include <vector>

namespace jourdain::support {

struct ProcessResult {
  int status = 0;      ///< exit status; 128 + signal where a signal ended it
  std::string output;  ///< stdout and stderr together
};

/// Runs `command[0]`, found on the PATH, with the other entries as arguments and no shell between. Its
/// temporary folder (TMPDIR) is its own and is removed with what it leaves there. Throws EnvironmentError when it
/// cannot be started.
ProcessResult run_process(const std::vector<std::string>& command);

}  // namespace jourdain::support
