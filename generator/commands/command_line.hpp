// The command as a function: what `main` calls, and what tests call many times in one process.
#pragma once

namespace jourdain::commands {

/// Parses the arguments, runs the command and maps what went wrong to an exit status (load.hpp). Throws nothing.
int run_command_line(int argc, char** argv) noexcept;

}  // namespace jourdain::commands
