// Arrays of constants that expressions and programs take entries of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace jourdain::support {

inline constexpr std::uint32_t kLargestArrayNumber = (1u << 24) - 1;

/// The number of the array with these values, which follows from them; where it is that of another array already, the
/// next one. It has 24 binary digits, so that a float holds it. Any thread may ask.
std::uint32_t number_of_array(std::span<const double> values);

/// The values of an array that has this number. They stay where they are.
const std::vector<double>& array_of(std::uint32_t number);

}  // namespace jourdain::support
