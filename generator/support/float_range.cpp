#include "support/float_range.hpp"

#include <cmath>
#include <limits>

namespace jourdain::support {

std::string float_overflow(double value) {
  return std::isinf(static_cast<float>(value)) ? "is beyond the range of float" : "";
}

std::string float_underflow(double value) {
  const auto narrow = static_cast<float>(value);
  if (value == 0 || !(std::fabs(narrow) < std::numeric_limits<float>::min())) return "";
  return narrow == 0 ? "is zero in float" : "has few digits in float, near to the end of its range";
}

std::string float_misfit(double value) {
  const std::string overflow = float_overflow(value);
  return overflow.empty() ? float_underflow(value) : overflow;
}

}  // namespace jourdain::support
