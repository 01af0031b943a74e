// Names that mean something in Python.
#pragma once

#include <string>

namespace jourdain::commands {

/// Whether it is a word of the language, which cannot stand behind a dot.
bool is_python_word(const std::string& name);

/// Why no module can have the name: it is a word of the language, or a module of Python's library or for numbers has
/// it, which programs would no longer find. Empty where one can.
std::string wrong_module_name(const std::string& name);

}  // namespace jourdain::commands
