// Functions that emitted code calls and its user defines.
#pragma once

#include <string>
#include <vector>

#include "ir/module.hpp"
#include "support/called_function.hpp"

namespace jourdain::emit {

/// All that programs call, partial derivatives too, by name.
std::vector<support::CalledFunction> called_in(const ir::Module& module);

/// "partial derivative of grip by slip"; empty for a function itself.
std::string remark_of(const support::CalledFunction& function);

}  // namespace jourdain::emit
