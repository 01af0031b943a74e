// Numbers of so many binary digits.
#pragma once

#include <cln/lfloat.h>
#include <cln/real.h>

namespace jourdain::support {

/// The nearest fraction whose numerator has `digits` binary digits; of 0: 0.
cln::cl_R with_binary_digits(const cln::cl_LF& value, int digits);

}  // namespace jourdain::support
