// Emitted functions compiled by the machine's compiler and measured: time, instructions, bytes of code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands/load.hpp"

namespace jourdain::commands {

struct BenchChoices {
  std::vector<std::string> compiler, flags;  ///< words of the command, without the language
  bool is_float = false;
  int states = 16;
  std::uint64_t seed = 1;
  int blocks = 400;
  double block_length = 2e-5;  ///< s; one call at each state at least
  double step = 1e-4;          ///< s, of steps
};

/// Of the calls at different states.
struct Instructions {
  double mean = 0;
  long long least = 0, most = 0;
};

/// What a processor cannot be faster than: the floating-point arithmetic of a call, were all else free.
struct Floor {
  double arithmetic = 0;  ///< its instructions; one for all numbers of a vector
  double outside = 0;     ///< instructions of libraries, whose arithmetic is not counted
  double time = 0;        ///< s, at the rates of instructions that do not wait for each other
};

/// Of one emitted function.
struct BenchRow {
  std::string name;
  int calls = 0;                   ///< in a block
  double fastest = 0, median = 0;  ///< s a call, of the blocks
  int finite = 0;                  ///< states that give finite numbers
  std::optional<long> code;  ///< bytes, with what it calls of the model; nothing where the linker makes it
  std::optional<Instructions> instructions;  ///< with libm's; nothing where they could not be counted
  std::optional<Floor> floor;  ///< nothing where single steps could not be counted or met x87's arithmetic
  bool x87 = false;            ///< single steps met x87's arithmetic
};

struct BenchResult {
  std::vector<BenchRow> rows;  ///< as emitted, without initial_state
  std::string compiler;        ///< name and version
  std::string processor;
  std::string counter;  ///< what counted instructions, or why nothing did
};

/// Compiles `compiled`, which must have `initial_state` and what closes its loops, with these options and measures its
/// functions: at drawn states, in short blocks that take turns over the functions. Steps go on from a state, other
/// functions take the states in turn. Throws EnvironmentError where the compiler cannot be run or fails.
BenchResult measure_functions(const LoadedMechanism& loaded, const CompiledModel& compiled,
                              const BenchChoices& choices);

}  // namespace jourdain::commands
