// What an emitted function takes of stack and program memory, as the compiler says.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "commands/build_model.hpp"

namespace jourdain::commands {

/// Bytes of a function with all of the model's functions that it calls; libm's are not known.
struct CodeCost {
  long stack = 0;      ///< of the deepest chain of calls: enough for every call, as no frame depends on data
  long code = 0;       ///< machine code, each function once; literals only where they lie among the code
  std::string symbol;  ///< the linker's name of the function
};

/// What compiles emitted code and lists the symbols of what it makes.
struct CodeTools {
  std::vector<std::string> compiler;  ///< with its options
  std::string nm = "nm";
};

/// What to look for, by name ("model" for the constructor): what the name in C++ of a function of `compiled` in these
/// numbers begins with.
std::map<std::string, std::string> function_signatures(const std::string& name, const CompiledModel& compiled,
                                                       NumberType number);

/// By name, of the functions in `source`, which is compiled to `object`.o; those that are not in there are left out.
/// The compiler must know -fcallgraph-info. Throws EnvironmentError where the code does not compile or nm fails.
std::map<std::string, CodeCost> source_costs(const CodeTools& tools, const std::string& source,
                                             const std::string& object,
                                             const std::map<std::string, std::string>& signatures);

/// By name, "model" for the constructor, of NAME.cpp of `compiled` with the options of `build_model`. Nothing
/// where the compiler draws no graph of calls, as clang, or g++ with -flto. Throws EnvironmentError where the code
/// does not compile or `nm` cannot be run.
std::optional<std::map<std::string, CodeCost>> code_costs(const std::string& name,
                                                          const CompiledModel& compiled, NumberType number);

/// Bytes of machine code by name, of the functions in `object`.o with all that they call of it, each once. It must have
/// been compiled with -ffunction-sections, which every compiler knows. Functions without code are left out: all, where
/// the linker makes it (-flto). Throws EnvironmentError where nm or objdump cannot be run.
std::map<std::string, long> linked_code(const std::string& object,
                                        const std::map<std::string, std::string>& signatures);

}  // namespace jourdain::commands
