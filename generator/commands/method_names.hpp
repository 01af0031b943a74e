// Steppers by name on the command line.
#pragma once

#include <string>
#include <vector>

#include "commands/load.hpp"
#include "programs/derivatives.hpp"

namespace jourdain::commands {

/// Empty where a stepper has that name; otherwise what is wrong.
std::string check_method(const std::string& method);

/// Empty where each of `functions` that is a step keeps its order with these terms (names with or without "_step").
std::string check_derivative_terms(const std::vector<std::string>& functions,
                                   programs::DerivativeTerms terms);

/// Why functions that are steps cannot be had of that mechanism: see check_multistep; linearly implicit ones need all
/// velocities. Empty: they can.
std::string check_steps(const std::vector<std::string>& functions, const LoadedMechanism& loaded);

/// All steppers, or those that keep their order with these terms.
std::vector<std::string> methods_for(programs::DerivativeTerms terms);

inline constexpr std::size_t kMostVelocities = 24;  ///< of scenes whose derivatives are compiled unasked

/// Those, without linearly implicit ones where a scene is large, which a note on stderr says.
std::vector<std::string> default_methods(programs::DerivativeTerms terms, std::size_t velocities);

}  // namespace jourdain::commands
