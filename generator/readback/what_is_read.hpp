// What the numbers of a model depend on, from the validated programs.
#pragma once

#include <string>
#include <vector>

#include "readback/expected.hpp"

namespace jourdain::readback {

/// For each number of the variable a '1' or '0' for t, each entry of y, z and u. Empty where no program computes it.
std::vector<std::string> what_is_read(const ExpectedVariable& variable, const Expected& expected);

}  // namespace jourdain::readback
