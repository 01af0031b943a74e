// Compilers and what comes with them, run for what they make or say.
#pragma once

#include <string>
#include <vector>

namespace jourdain::commands {

/// What the program says. Throws EnvironmentError, with its first words, where it cannot be started or fails.
std::string run_tool(const std::vector<std::string>& command);

}  // namespace jourdain::commands
