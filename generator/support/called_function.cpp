#include "support/called_function.hpp"

#include <algorithm>
#include <functional>

#include "support/check.hpp"
#include "support/numbered.hpp"

namespace jourdain::support {

namespace {

Numbered<CalledFunction>& functions() {
  static Numbered<CalledFunction> made;
  return made;
}

ContentHash hash_of(const CalledFunction& function) {
  ContentHash hash;
  hash.take(function.member() + '\n' + function.name + '\n');
  for (const std::string& argument : function.arguments) hash.take(argument + '\n');
  hash.take(function.low);
  hash.take(function.high);
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
  return functions().number_of(hash_of(function), function, std::equal_to<CalledFunction>());
}

const CalledFunction& called_function(std::uint32_t number) { return functions().at(number); }

std::uint32_t number_of_slope(std::uint32_t number, std::size_t argument) {
  CalledFunction slope = called_function(number);
  JD_CHECK(argument < slope.arguments.size(), "'{}' has {} arguments", slope.name, slope.arguments.size());
  slope.by.insert(std::upper_bound(slope.by.begin(), slope.by.end(), argument), argument);
  return number_of_called(slope);
}

double phase_of_called(const CalledFunction& function) {
  CalledFunction plain = function;
  plain.by.clear();
  return static_cast<double>(hash_of(plain).value() >> 54) / 256;
}

}  // namespace jourdain::support
