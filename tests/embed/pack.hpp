// A number type with several lanes, as users of vector instructions have them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "embed/emitted_sines.hpp"

namespace jourdain::tests {

/// Four values side by side.
struct Pack {
  std::array<double, 4> v{};

  Pack() = default;
  explicit Pack(double x) { v.fill(x); }
  template <class F>
  static Pack each(F f) {
    Pack r;
    for (std::size_t i = 0; i < 4; ++i) r.v[i] = f(i);
    return r;
  }
  friend Pack operator+(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return a.v[i] + b.v[i]; });
  }
  friend Pack operator-(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return a.v[i] - b.v[i]; });
  }
  friend Pack operator*(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return a.v[i] * b.v[i]; });
  }
  friend Pack operator/(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return a.v[i] / b.v[i]; });
  }
  friend Pack operator-(const Pack& a) {
    return each([&](std::size_t i) { return -a.v[i]; });
  }
  friend Pack sin(const Pack& a) {
    return each([&](std::size_t i) { return emitted_sine(a.v[i]); });
  }
  friend Pack cos(const Pack& a) {
    return each([&](std::size_t i) { return emitted_cosine(a.v[i]); });
  }
  friend Pack sqrt(const Pack& a) {
    return each([&](std::size_t i) { return std::sqrt(a.v[i]); });
  }
  friend Pack fabs(const Pack& a) {
    return each([&](std::size_t i) { return std::fabs(a.v[i]); });
  }
  friend Pack atan(const Pack& a) {
    return each([&](std::size_t i) { return std::atan(a.v[i]); });
  }
  friend Pack floor(const Pack& a) {
    return each([&](std::size_t i) { return std::floor(a.v[i]); });
  }
  friend Pack exp(const Pack& a) {
    return each([&](std::size_t i) { return std::exp(a.v[i]); });
  }
  friend Pack tanh(const Pack& a) {
    return each([&](std::size_t i) { return std::tanh(a.v[i]); });
  }
  friend std::array<bool, 4> operator<(const Pack& a, const Pack& b) {
    return {a.v[0] < b.v[0], a.v[1] < b.v[1], a.v[2] < b.v[2], a.v[3] < b.v[3]};
  }
  friend Pack select(const std::array<bool, 4>& mask, const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return mask[i] ? a.v[i] : b.v[i]; });
  }
  friend Pack atan2(const Pack& a, const Pack& b) {
    return each([&](std::size_t i) { return emitted_arctangent(a.v[i], b.v[i]); });
  }
};

}  // namespace jourdain::tests
