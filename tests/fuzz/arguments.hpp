// Random command lines, drawn from the options that the command declares itself.
#pragma once

#include <string>
#include <vector>

#include "properties/random.hpp"

namespace jourdain::tests {

/// A command of the command line with some of its options, valid values and others, and `model` at some place. What is
/// asked for ends within seconds where it is valid: durations and numbers of steps are short, or far beyond what is
/// taken. Commands that call the C++ compiler are rare.
std::vector<std::string> random_arguments(const std::string& model, Random& random);

}  // namespace jourdain::tests
