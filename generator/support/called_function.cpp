#include "support/called_function.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <mutex>

#include "support/check.hpp"
#include "support/constant_array.hpp"

namespace jourdain::support {

namespace {

struct Known {
  std::mutex mutex;
  std::map<std::uint32_t, CalledFunction> by_number;
};

Known& known() {
  static Known made;
  return made;
}

/// FNV-1a over names and derivatives.
std::uint64_t hash_of(const CalledFunction& function) {
  std::uint64_t hash = 14695981039346656037u;
  const auto take = [&hash](const std::string& text) {
    for (const char c : text + '\n') hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  };
  take(function.member());
  take(function.name);
  for (const std::string& argument : function.arguments) take(argument);
  for (const double end : {function.low, function.high})
    for (int byte = 0; byte < 8; ++byte)
      hash = (hash ^ ((std::bit_cast<std::uint64_t>(end) >> (8 * byte)) & 0xff)) * 1099511628211u;
  return hash;
}

}  // namespace

std::string CalledFunction::member() const {
  std::string text = name;
  for (const std::size_t argument : by) text += "_" + arguments[argument];
  return text;
}

std::uint32_t number_of_called(const CalledFunction& function) {
  JD_CHECK(!function.arguments.empty(), "'{}' has no argument", function.name);
  const std::uint64_t hash = hash_of(function);
  const std::lock_guard lock(known().mutex);
  for (auto number = static_cast<std::uint32_t>((hash ^ (hash >> 24) ^ (hash >> 48)) & kLargestArrayNumber);;
       number = (number + 1) & kLargestArrayNumber) {
    const auto [place, is_new] = known().by_number.try_emplace(number, function);
    if (is_new || place->second == function) return number;
  }
}

const CalledFunction& called_function(std::uint32_t number) {
  const std::lock_guard lock(known().mutex);
  const auto place = known().by_number.find(number);
  JD_CHECK(place != known().by_number.end(), "no function has the number {}", number);
  return place->second;
}

std::uint32_t number_of_slope(std::uint32_t number, std::size_t argument) {
  CalledFunction slope = called_function(number);
  JD_CHECK(argument < slope.arguments.size(), "'{}' has {} arguments", slope.name, slope.arguments.size());
  slope.by.insert(std::upper_bound(slope.by.begin(), slope.by.end(), argument), argument);
  return number_of_called(slope);
}

double phase_of_called(const CalledFunction& function) {
  CalledFunction plain = function;
  plain.by.clear();
  return static_cast<double>(hash_of(plain) >> 54) / 256;
}

}  // namespace jourdain::support
