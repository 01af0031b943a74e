// Containers of the standard library count with std::size_t, those of Eigen with std::ptrdiff_t, joints with int.
#pragma once

#include <concepts>
#include <cstddef>

namespace jourdain::support {

template <std::integral Index>
constexpr std::ptrdiff_t at(Index i) {
  return static_cast<std::ptrdiff_t>(i);
}

constexpr std::size_t subscript(int i) { return static_cast<std::size_t>(i); }

}  // namespace jourdain::support
