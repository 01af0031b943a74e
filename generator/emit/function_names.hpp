// What functions are called in emitted code, in C++ and C alike.
#pragma once

#include "support/elementary_functions.hpp"

namespace jourdain::emit {

const char* function_name(support::Function function);

}  // namespace jourdain::emit
