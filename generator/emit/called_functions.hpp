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

/// How often each value of a program stands in text: a list of arguments is written into each call that takes it.
std::vector<std::size_t> uses_in_text(const ir::Program& program);

}  // namespace jourdain::emit
