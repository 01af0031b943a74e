// How many random cases a test draws.
#pragma once

#include <cstdint>

namespace jourdain::tests {

/// All of them in a release build, a fifth under the sanitizers, which look for other errors and are slow.
constexpr std::uint64_t cases(std::uint64_t all) {
#ifdef JOURDAIN_SANITIZED
  return all / 5;
#else
  return all;
#endif
}

}  // namespace jourdain::tests
