#include "support/binary_digits.hpp"

#include <cln/cln.h>

namespace jourdain::support {

cln::cl_R with_binary_digits(const cln::cl_LF& value, int digits) {
  if (cln::zerop(value)) return 0;
  const cln::cl_I shift = cln::cl_I(digits) - cln::cl_I(static_cast<long>(cln::float_exponent(value)));
  return cln::round1(value * cln::expt(cln::cl_RA(2), shift)) * cln::expt(cln::cl_RA(2), -shift);
}

}  // namespace jourdain::support
