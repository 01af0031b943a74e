// The processors that firmware is built and simulated for: a row each in the table of target.cpp. Boards are in
// templates/firmware/.
#pragma once

#include <string>
#include <vector>

namespace jourdain::commands {

struct Target {
  std::string name;                  ///< on the command line
  std::string processor;             ///< in words
  bool usually_float = false;        ///< its floating-point unit has single precision alone
  std::string tools;                 ///< what names of the compiler's programs begin with
  std::vector<std::string> options;  ///< of the compiler: processor, number formats, library
  std::string board;                 ///< name of the start-up code and the linker script
  std::string return_instruction;    ///< from a function to its caller
  std::vector<std::string> machine;  ///< the simulator, with the board
  std::string compiler_package, library_package, simulator_package;  ///< Debian's
};

const std::vector<Target>& all_targets();

std::vector<std::string> target_names();

/// Nothing where no target has the name.
const Target* find_target(const std::string& name);

/// Empty where a target has that name; otherwise what is wrong.
std::string check_target(const std::string& name);

/// Throws EnvironmentError with the Debian packages where the compiler, its library or the simulator is missing.
void check_tools(const Target& target);

/// The first lines that the compiler and the simulator say of their version.
std::string compiler_version(const Target& target);
std::string simulator_version(const Target& target);

/// The compiler of C++17 and the options for emitted code, without what is to be compiled.
std::vector<std::string> target_compiler(const Target& target);

/// The same of C99.
std::vector<std::string> target_c_compiler(const Target& target);

/// Writes start-up code, linker script and board.h into `folder`.
void write_board(const Target& target, const std::string& folder);

/// Links object files with the board of `folder` (see write_board) and the C library to folder/`name`.elf. Throws
/// EnvironmentError with the words of compiler and linker.
void link_firmware(const Target& target, const std::string& folder, const std::string& name,
                   const std::vector<std::string>& objects);

/// What folder/`name`.elf writes, run in the simulator an instruction per nanosecond. Throws EnvironmentError where it
/// does not end with status 0.
std::string run_firmware(const Target& target, const std::string& folder, const std::string& name);

}  // namespace jourdain::commands
