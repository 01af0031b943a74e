// The command, called in a child of this process: no other program is started, and whatever goes wrong ends the child
// alone.
#pragma once

#include <string>
#include <vector>

namespace jourdain::tests {

/// What a case may take. Under the sanitizers, which need much address space, memory is not limited.
inline constexpr double kMaximumSeconds = 20;
inline constexpr long kMaximumMegabytes = 1'000;

struct ChildResult {
  int status = 0;     ///< exit status; 128 + signal where one ended it
  bool read = false;  ///< the description, the last argument ending in .toml or .urdf, passed its reader
  bool too_slow = false, too_large = false;
  double seconds = 0;          ///< of processor time, with what it started
  std::string output, errors;  ///< stdout and stderr, a megabyte of each at most
};

/// Runs `arguments` in `folder`/case, with temporary files in `folder`/tmp.
ChildResult run_in_child(const std::string& folder, const std::vector<std::string>& arguments);

}  // namespace jourdain::tests
