// What emitted functions take on a target: code and stack as the compiler says, stack and instructions as simulated.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "commands/code_cost.hpp"
#include "commands/target.hpp"

namespace jourdain::commands {

/// Of a function with all that it calls.
struct TargetCost {
  CodeCost code;               ///< without libm's functions
  long painted_stack = 0;      ///< bytes written below the caller's frame in one call, libm's among them
  long long instructions = 0;  ///< of one call, libm's among them
};

struct TargetCosts {
  std::map<std::string, TargetCost> functions;      ///< by name, "model" for the constructor
  std::vector<std::pair<std::string, long>> sizes;  ///< bytes of "Model", "State" and so on, in order
  long constants = 0;                               ///< bytes of read-only data beside the code
  std::string library;                              ///< name and version of the C library
};

/// How a function is called for the counts: from the described start, with parameters and inputs as given.
struct TargetStart {
  std::vector<double> parameters, inputs;
  double step = 0;  ///< s
};

/// Compiles the functions of `compiled` for the target, runs each in the simulator and counts. Steppers that remember
/// earlier steps have done three before. The same files give the same counts, always. Throws EnvironmentError where a
/// tool is missing or fails.
TargetCosts target_costs(const std::string& name, const CompiledModel& compiled, NumberType number,
                         const Target& target, const TargetStart& start);

}  // namespace jourdain::commands
