#include "support/constant_array.hpp"

#include <algorithm>
#include <bit>

#include "support/check.hpp"
#include "support/numbered.hpp"

namespace jourdain::support {

namespace {

/// Zeros of different signs are different.
bool are_same(std::span<const double> a, std::span<const double> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

Numbered<std::vector<double>>& arrays() {
  static Numbered<std::vector<double>> made;
  return made;
}

}  // namespace

std::uint32_t number_of_array(std::span<const double> values) {
  JD_CHECK(!values.empty(), "an array without values");
  ContentHash hash;
  for (const double value : values) hash.take(value);
  return arrays().number_of(hash, {values.begin(), values.end()}, are_same);
}

const std::vector<double>& array_of(std::uint32_t number) { return arrays().at(number); }

}  // namespace jourdain::support
