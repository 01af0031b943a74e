#include "support/constant_array.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <mutex>

#include "support/check.hpp"

namespace jourdain::support {

namespace {

/// FNV-1a over the bits of the values.
std::uint32_t first_number(std::span<const double> values) {
  std::uint64_t hash = 14695981039346656037u;
  for (const double value : values)
    for (int byte = 0; byte < 8; ++byte)
      hash = (hash ^ ((std::bit_cast<std::uint64_t>(value) >> (8 * byte)) & 0xff)) * 1099511628211u;
  return static_cast<std::uint32_t>((hash ^ (hash >> 24) ^ (hash >> 48)) & kLargestArrayNumber);
}

/// Zeros of different signs are different.
bool are_same(std::span<const double> a, std::span<const double> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

struct Arrays {
  std::mutex mutex;
  std::map<std::uint32_t, std::vector<double>> by_number;
};

Arrays& arrays() {
  static Arrays made;
  return made;
}

}  // namespace

std::uint32_t number_of_array(std::span<const double> values) {
  JD_CHECK(!values.empty(), "an array without values");
  Arrays& known = arrays();
  const std::lock_guard lock(known.mutex);
  for (std::uint32_t number = first_number(values);; number = (number + 1) & kLargestArrayNumber) {
    const auto [place, is_new] = known.by_number.try_emplace(number, values.begin(), values.end());
    if (is_new || are_same(place->second, values)) return number;
  }
}

const std::vector<double>& array_of(std::uint32_t number) {
  Arrays& known = arrays();
  const std::lock_guard lock(known.mutex);
  const auto place = known.by_number.find(number);
  JD_CHECK(place != known.by_number.end(), "no array has the number {}", number);
  return place->second;
}

}  // namespace jourdain::support
