// Numbers, names and expressions that a reader may choke on, and some that it must take.
#pragma once

#include <string>
#include <vector>

#include "properties/random.hpp"

namespace jourdain::tests {

template <class T>
const T& one_of(const std::vector<T>& list, Random& random) {
  return list[random.below(list.size())];
}

/// As it may stand in TOML: zero, the ends of what double and long can hold, what is no number, forms that few use.
std::string hostile_number(Random& random);
/// A number as it may stand anywhere; half of them are usual ones.
std::string any_number(Random& random);
/// Words of C++, of <math.h> and of the emitted code, empty ones, very long ones, ones with control characters or
/// beyond ASCII.
std::string hostile_name(Random& random);
/// By a small grammar over `names`, up to `depth` operations deep; at times with a fault in it.
std::string any_expression(const std::vector<std::string>& names, int depth, Random& random);

}  // namespace jourdain::tests
