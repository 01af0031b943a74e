// Sines, cosines and arctangents of emitted code, which all models have alike: for lanes that shall have the bits of
// scalars.
#pragma once

#include "four_bar/four_bar_kernels.hpp"

namespace jourdain::tests {

template <class Scalar>
Scalar emitted_sine(Scalar x) {
  return four_bar::detail::sine(x);
}
template <class Scalar>
Scalar emitted_cosine(Scalar x) {
  return four_bar::detail::cosine(x);
}
template <class Scalar>
Scalar emitted_arctangent(Scalar y, Scalar x) {
  return four_bar::detail::arctangent2(y, x);
}

}  // namespace jourdain::tests
