// The files of a Python module: its text, its stub, and the C that its library has beside the model's.
#pragma once

#include <string>

#include "compile/compile.hpp"

namespace jourdain::commands {

/// NAME.py. `build` tells this module and its library from others of the name; the library answers with it.
std::string module_text(const CompileOptions& options, const std::string& title, const std::string& build);

/// NAME.pyi: names, types and units for editors and checkers of types.
std::string stub_text(const CompiledModel& compiled, const std::string& title);

/// NAME_batch.c: calls at many states, and `jourdain_build`.
std::string batch_text(const CompileOptions& options, const CompiledModel& compiled,
                       const std::string& build);

/// NAME_packs.cpp: the functions of ensembles, of C linkage.
std::string packs_text(const std::string& name, bool turns_sines);

}  // namespace jourdain::commands
