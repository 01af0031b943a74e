// A number type that counts its operations; emitted code is instantiated with it.
#pragma once

#include <array>
#include <functional>
#include <type_traits>

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

/// Operations that one operation on lanes does besides the first.
inline std::size_t counted_with_others = 0;

/// N numbers that are computed with at once.
template <std::size_t N>
struct CountingLanes {
  std::array<Counting, N> lanes;

  CountingLanes() = default;
  template <class... Each, class = std::enable_if_t<sizeof...(Each) == N>>
  CountingLanes(const Each&... each) : lanes{each...} {}
  const Counting& operator[](int lane) const { return lanes[static_cast<std::size_t>(lane)]; }

  friend CountingLanes operator+(const CountingLanes& a, const CountingLanes& b) {
    return at_once(a, b, std::plus<>());
  }
  friend CountingLanes operator-(const CountingLanes& a, const CountingLanes& b) {
    return at_once(a, b, std::minus<>());
  }
  friend CountingLanes operator*(const CountingLanes& a, const CountingLanes& b) {
    return at_once(a, b, std::multiplies<>());
  }
  friend CountingLanes operator/(const CountingLanes& a, const CountingLanes& b) {
    return at_once(a, b, std::divides<>());
  }
  friend CountingLanes operator+(const CountingLanes& a, const Counting& b) { return a + all(b); }
  friend CountingLanes operator-(const CountingLanes& a, const Counting& b) { return a - all(b); }
  friend CountingLanes operator*(const CountingLanes& a, const Counting& b) { return a * all(b); }
  friend CountingLanes operator/(const CountingLanes& a, const Counting& b) { return a / all(b); }
  friend CountingLanes operator+(const Counting& a, const CountingLanes& b) { return all(a) + b; }
  friend CountingLanes operator-(const Counting& a, const CountingLanes& b) { return all(a) - b; }
  friend CountingLanes operator*(const Counting& a, const CountingLanes& b) { return all(a) * b; }
  friend CountingLanes operator/(const Counting& a, const CountingLanes& b) { return all(a) / b; }

 private:
  static CountingLanes all(const Counting& value) {
    CountingLanes result;
    result.lanes.fill(value);
    return result;
  }
  template <class Operation>
  static CountingLanes at_once(CountingLanes a, const CountingLanes& b, Operation operation) {
    for (std::size_t k = 0; k < N; ++k) a.lanes[k] = operation(a.lanes[k], b.lanes[k]);
    counted_with_others += N - 1;
    return a;
  }
};

}  // namespace jourdain::tests
