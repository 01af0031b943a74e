// What a header in C++ says of the functions that its user defines.
#pragma once

#include <string>
#include <vector>

#include "support/called_function.hpp"

namespace jourdain::emit::cpp {

/// The struct that has them, declared; empty where nothing is called.
std::string user_functions(const std::string& model, const std::vector<support::CalledFunction>& called);

}  // namespace jourdain::emit::cpp
