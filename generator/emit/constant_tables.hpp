// Arrays of constants that emitted code takes entries of, each by a function of its own.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ir/module.hpp"

namespace jourdain::emit {

/// Numbers of the arrays, see support::number_of_array.
std::set<std::uint32_t> arrays_in(const ir::Module& module);

/// Of the function for an array; the number is whole.
std::string table_function(double number);
bool is_table_function(std::string_view name);

/// One of its values is beyond what a float holds.
bool overflows_float(std::uint32_t array);

/// In lines, with commas between them, from the line after the current one on.
std::string listed(const std::vector<std::string>& numbers);

}  // namespace jourdain::emit
