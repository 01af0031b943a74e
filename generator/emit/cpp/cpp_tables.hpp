// Functions that take entries of arrays of constants, in C++.
#pragma once

#include <cstdint>
#include <string>

namespace jourdain::emit::cpp {

std::string table_text(std::uint32_t array);

}  // namespace jourdain::emit::cpp
