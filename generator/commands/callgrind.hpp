// Instructions of single functions, counted by valgrind's callgrind.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace jourdain::commands {

/// All calls of one function from another.
struct CountedCalls {
  std::string caller, callee;             ///< as C++ writes them, with the types of their arguments
  long long calls = 0, instructions = 0;  ///< of the callee with all that it calls
};

/// Reads a file that callgrind wrote.
std::vector<CountedCalls> read_callgrind(const std::string& text);

/// First line of `valgrind --version`; nothing where it is not installed.
std::optional<std::string> valgrind_version();

/// Runs `program` without arguments in callgrind. Nothing where valgrind cannot run it, as with instructions that it
/// does not know.
std::optional<std::vector<CountedCalls>> count_calls(const std::string& program, const std::string& folder);

}  // namespace jourdain::commands
