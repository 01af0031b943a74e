// What an emitted function takes of stack and program memory, as the compiler says.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "commands/build_model.hpp"

namespace jourdain::commands {

/// Bytes of a function with all of the model's functions that it calls; libm's are not known.
struct CodeCost {
  long stack = 0;  ///< of the deepest chain of calls: enough for every call, as no frame depends on data
  long code = 0;   ///< machine code, each function once; without literals
};

/// By name, "model" for the constructor, of NAME.cpp of `compiled` with the options of `build_model`. Nothing
/// where the compiler knows no -fcallgraph-info, as clang. Throws EnvironmentError where the code does not
/// compile or `nm` cannot be run.
std::optional<std::map<std::string, CodeCost>> code_costs(const std::string& name,
                                                          const CompiledModel& compiled, NumberType number);

}  // namespace jourdain::commands
