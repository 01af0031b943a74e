// From emitted sources to a loaded model, by the C++ compiler of the machine.
#pragma once

#include <string>

#include "compile/compile.hpp"
#include "studies/loaded_model.hpp"

namespace jourdain::commands {

/// What the loaded model computes in; "long" has 50 digits (jourdain/long_real.hpp).
enum class NumberType { kDouble, kFloat, kLong };

/// Functions of the table of a loaded model that has these steppers.
std::vector<std::string> loadable_functions(const std::vector<std::string>& steppers);

/// Compiles the files of `compiled` with the C++ compiler (environment variable CXX, else c++) in a temporary
/// folder and loads the result. `compiled` must have the functions of `loadable_functions`. Throws
/// EnvironmentError with the compiler's words when that fails.
studies::LoadedModel build_model(const std::string& name, const CompiledModel& compiled, NumberType number);

/// The machine's compiler in words, "ccache g++": the environment variable CXX, else c++.
std::vector<std::string> machine_compiler();

/// The compiler, the language and the options that decide speed: what comes before the files.
std::vector<std::string> compiler_command(NumberType number);

/// The compiler's name and the options that decide speed.
std::string compiler_text(NumberType number);

}  // namespace jourdain::commands
