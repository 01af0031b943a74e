// Emitted code, compiled by g++ and by clang++ and stepped.
#pragma once

#include <string>

namespace jourdain::tests {

/// Compiles the sources in `folder`/case/out with both, steps the initial state 100 times by rk4_step with h = 1 ms and
/// inputs of zero, and compares what both programs print. Returns what went wrong, or "".
std::string compile_and_step(const std::string& folder);

}  // namespace jourdain::tests
