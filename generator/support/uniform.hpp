// Uniform random numbers that are the same on every platform; std::uniform_real_distribution is not.
#pragma once

#include <cstdint>
#include <random>

namespace jourdain::support {

class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}

  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace jourdain::support
