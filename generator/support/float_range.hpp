// What float does to numbers of double.
#pragma once

#include <string>

namespace jourdain::support {

/// "is beyond the range of float"; empty: it is not.
std::string float_overflow(double value);

/// "is zero in float", or that it has few digits there; empty: it has as many as others.
std::string float_underflow(double value);

/// Either of them; empty: float has room for the number.
std::string float_misfit(double value);

}  // namespace jourdain::support
