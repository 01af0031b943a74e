// Functions that take entries of arrays of constants, in C.
#pragma once

#include <cstdint>
#include <string>

#include "emit/c/spelling.hpp"

namespace jourdain::emit::c {

std::string table_text(std::uint32_t array, const CNames& names);

}  // namespace jourdain::emit::c
