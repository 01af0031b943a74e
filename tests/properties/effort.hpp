// How many random cases a test draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace jourdain::tests {

/// Whether every case is drawn, as `./dev soak` asks by the environment's JOURDAIN_CASES.
inline bool draws_all_cases() {
  const char* asked = std::getenv("JOURDAIN_CASES");
  return asked != nullptr && std::string_view(asked) == "all";
}

/// Of `all` cases those that a test draws: a sixth, or all where draws_all_cases(); under the sanitizers, which look
/// for other errors and are slow, a twentieth. At least one.
inline std::uint64_t cases(std::uint64_t all) {
#ifdef JOURDAIN_SANITIZED
  return (all + 19) / 20;
#else
  return draws_all_cases() ? all : (all + 5) / 6;
#endif
}

/// Whether a test looks at the `number`-th of several: at one in `of`, or at all where draws_all_cases().
inline bool draws(std::size_t number, std::size_t of) { return draws_all_cases() || number % of == 0; }

}  // namespace jourdain::tests
