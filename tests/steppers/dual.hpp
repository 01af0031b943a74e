// Numbers with a derivative: emitted code is instantiated with them, a second road to its Jacobians.
#pragma once

#include <cmath>

namespace jourdain::tests {

/// x + x' ε with ε² = 0.
struct Dual {
  double value = 0, slope = 0;

  Dual() = default;
  explicit Dual(double v, double s = 0) : value(v), slope(s) {}

  friend Dual operator+(Dual a, Dual b) { return Dual(a.value + b.value, a.slope + b.slope); }
  friend Dual operator-(Dual a, Dual b) { return Dual(a.value - b.value, a.slope - b.slope); }
  friend Dual operator*(Dual a, Dual b) {
    return Dual(a.value * b.value, a.value * b.slope + a.slope * b.value);
  }
  friend Dual operator/(Dual a, Dual b) {
    return Dual(a.value / b.value, (a.slope - a.value / b.value * b.slope) / b.value);
  }
  friend Dual operator-(Dual a) { return Dual(-a.value, -a.slope); }
  friend Dual sqrt(Dual a) { return Dual(std::sqrt(a.value), a.slope / (2 * std::sqrt(a.value))); }
  friend Dual sin(Dual a) { return Dual(std::sin(a.value), a.slope * std::cos(a.value)); }
  friend Dual cos(Dual a) { return Dual(std::cos(a.value), -a.slope * std::sin(a.value)); }
  friend Dual atan2(Dual a, Dual b) {
    return Dual(std::atan2(a.value, b.value),
                (b.value * a.slope - a.value * b.slope) / (a.value * a.value + b.value * b.value));
  }
};

}  // namespace jourdain::tests
