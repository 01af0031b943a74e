// Emitted sources to a loaded model: the system's C++ compiler at work.
#pragma once

#include <string>

#include "compile.hpp"
#include "studies/loaded_model.hpp"
#include "support/process.hpp"

namespace jourdain::commands {

/// Compiles the emitted files with $CXX (default c++) in a temporary folder, which the loaded model does not need any
/// more. `real` is double or float. Throws EnvironmentError with the compiler's words when that fails.
studies::LoadedModel build_model(const std::string& name, const CompiledModel& compiled,
                                 const std::string& real);

}  // namespace jourdain::commands
