// A random number generator whose doubles are the same on every platform (std::uniform_real_distribution's
// are not).
#pragma once

#include <cstddef>
#include <cstdint>

namespace jourdain::tests {

/// splitmix64 (Steele, Lea and Flood 2014). Equal seeds give equal sequences.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t word = state_;
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
    return word ^ (word >> 31);
  }
  /// Uniform in [0, 1), a multiple of 2⁻⁵³.
  double unit() { return double(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  /// Uniform in 0 … count − 1; count must not be 0.
  std::size_t below(std::size_t count) { return std::size_t(bits() % count); }
  bool chance(double probability) { return unit() < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::uint64_t state_;
};

}  // namespace jourdain::tests
