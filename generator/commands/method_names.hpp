// Steppers by name on the command line.
#pragma once

#include <string>

namespace jourdain::commands {

/// Empty where a stepper has that name; otherwise what is wrong.
std::string check_method(const std::string& method);

}  // namespace jourdain::commands
