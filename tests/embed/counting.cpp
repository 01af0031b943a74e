#include "embed/counting.hpp"

#include <cmath>

namespace jourdain::tests {

Counting sqrt(Counting a) { return ++counted.sqrt, Counting(std::sqrt(a.value)); }
Counting sin(Counting a) { return ++counted.sin, Counting(std::sin(a.value)); }
Counting cos(Counting a) { return ++counted.cos, Counting(std::cos(a.value)); }

}  // namespace jourdain::tests
