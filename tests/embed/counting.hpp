// A number type that counts its operations; emitted code is instantiated with it.
#pragma once

#include "ir/program.hpp"

namespace jourdain::tests {

/// Counts in a global, because emitted functions know nothing of it.
inline ir::Operations counted;

struct Counting {
  double value = 0;

  Counting() = default;
  explicit Counting(double v) : value(v) {}

  friend Counting operator+(Counting a, Counting b) { return ++counted.add, Counting(a.value + b.value); }
  friend Counting operator-(Counting a, Counting b) {
    return ++counted.subtract, Counting(a.value - b.value);
  }
  friend Counting operator*(Counting a, Counting b) {
    return ++counted.multiply, Counting(a.value * b.value);
  }
  friend Counting operator/(Counting a, Counting b) { return ++counted.divide, Counting(a.value / b.value); }
  friend Counting operator-(Counting a) { return ++counted.negate, Counting(-a.value); }
  friend Counting sqrt(Counting a);
  friend Counting sin(Counting a);
  friend Counting cos(Counting a);
  friend Counting atan2(Counting a, Counting b);
  friend Counting exp(Counting a);
  friend Counting tanh(Counting a);
  friend Counting atan(Counting a);
  friend Counting fabs(Counting a);
  /// Whoever compares chooses.
  friend bool operator<(Counting a, Counting b) { return ++counted.selections, a.value < b.value; }
  friend Counting table_entry(const double* values, int last, Counting i) {
    const double place = i.value > 0 ? (i.value < last ? i.value : last) : 0;
    return ++counted.selections, Counting(values[static_cast<int>(place)]);
  }
};

Counting sqrt(Counting a);
Counting sin(Counting a);
Counting cos(Counting a);
Counting atan2(Counting a, Counting b);
Counting exp(Counting a);
Counting tanh(Counting a);
Counting atan(Counting a);
Counting fabs(Counting a);

}  // namespace jourdain::tests
