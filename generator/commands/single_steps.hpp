// What a program says of its single steps, read with its disassembly: instructions of functions, and their arithmetic.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "commands/issue_kernels.hpp"

namespace jourdain::commands {

/// Of one function's calls, one at each state.
struct SteppedCalls {
  std::vector<double> instructions;  ///< of each call, with those of libraries
  ArithmeticCounts arithmetic;       ///< a call, the mean; without libraries
  double outside = 0;                ///< instructions of libraries, a call
  bool x87 = false;                  ///< arithmetic of x87's registers was met, which `arithmetic` has not
};

/// By function. `output` has lines "steps NAME COUNT...", "outside NAME COUNT", "at NAME ADDRESS COUNT" of a program
/// whose `disassembly` is objdump's, with names as C++ writes them; what belongs to functions with `own` in their name
/// is the measuring program's and is left out. Empty where the program has counted nothing.
std::map<std::string, SteppedCalls> read_steps(const std::string& output, const std::string& disassembly,
                                               const std::string& own);

}  // namespace jourdain::commands
