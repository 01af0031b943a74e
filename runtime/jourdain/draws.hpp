// SPDX-License-Identifier: MIT
// Random numbers by index: a draw is a function of a seed, a stream (a state of an ensemble, say) and a number in it,
// the same in whatever order, by however many threads, and on however many machines the draws are made.
#pragma once

#include <cmath>
#include <cstdint>

namespace jourdain {

namespace detail {

/// The finaliser of SplitMix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014).
inline std::uint64_t mixed(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace detail

/// Uniform in the open interval (0, 1), a multiple of 2^-53 and a half.
inline double uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t number) noexcept {
  const std::uint64_t golden = 0x9e3779b97f4a7c15u;
  const std::uint64_t bits = detail::mixed(
      detail::mixed(detail::mixed(seed + golden) + (stream + 1) * golden) + (number + 1) * golden);
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

/// Normal, of mean zero and deviation one (Box and Muller, Ann. Math. Stat. 29, 1958), from the uniform draws 2 number
/// and 2 number + 1 by the C library's logarithm and cosine.
inline double normal(std::uint64_t seed, std::uint64_t stream, std::uint64_t number) noexcept {
  return std::sqrt(-2 * std::log(uniform(seed, stream, 2 * number))) *
         std::cos(6.283185307179586 * uniform(seed, stream, 2 * number + 1));
}

/// Of mean `base` and deviation `width`; and uniform from base - width to base + width. Different numbers share no
/// draw.
inline double normal_about(double base, double width, std::uint64_t seed, std::uint64_t stream,
                           std::uint64_t number) noexcept {
  return base + width * normal(seed, stream, number);
}
inline double uniform_about(double base, double width, std::uint64_t seed, std::uint64_t stream,
                            std::uint64_t number) noexcept {
  return base + width * (2 * uniform(seed, stream, 2 * number) - 1);
}

}  // namespace jourdain
