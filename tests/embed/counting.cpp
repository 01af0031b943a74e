#include "embed/counting.hpp"

#include <cmath>

namespace jourdain::tests {

Counting sqrt(Counting a) { return ++counted.sqrt, Counting(std::sqrt(a.value)); }
Counting sin(Counting a) { return ++counted.sin, Counting(std::sin(a.value)); }
Counting cos(Counting a) { return ++counted.cos, Counting(std::cos(a.value)); }
Counting exp(Counting a) { return ++counted.functions, Counting(std::exp(a.value)); }
Counting tanh(Counting a) { return ++counted.functions, Counting(std::tanh(a.value)); }
Counting atan(Counting a) { return ++counted.functions, Counting(std::atan(a.value)); }
Counting fabs(Counting a) { return ++counted.selections, Counting(std::fabs(a.value)); }
Counting atan2(Counting a, Counting b) { return ++counted.atan2, Counting(std::atan2(a.value, b.value)); }

}  // namespace jourdain::tests
