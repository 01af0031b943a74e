// Steppers by name on the command line.
#pragma once

#include <string>
#include <vector>

#include "linearization.hpp"

namespace jourdain::commands {

/// Empty where a stepper has that name; otherwise what is wrong.
std::string check_method(const std::string& method);

/// Empty where each of `functions` that is a step keeps its order with these terms (names with or without "_step").
std::string check_derivative_terms(const std::vector<std::string>& functions, DerivativeTerms terms);

/// All steppers, or those that keep their order with these terms.
std::vector<std::string> methods_for(DerivativeTerms terms);

}  // namespace jourdain::commands
