// Orders of steppers, measured.
#pragma once

#include <cmath>
#include <vector>

namespace jourdain::tests {

/// Positions and velocities after `duration` (s) in `steps` steps from the initial state.
template <class State, class Input, class Step, class History>
std::vector<long double> after(State state, const Input& input, long double duration, int steps, Step step,
                               History history) {
  for (int i = 0; i < steps; ++i) step(state, input, duration / steps, history);
  std::vector<long double> numbers(std::begin(state.y), std::end(state.y));
  numbers.insert(numbers.end(), std::begin(state.z), std::end(state.z));
  return numbers;
}

inline long double distance(const std::vector<long double>& a, const std::vector<long double>& b) {
  long double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

/// Orders from the differences of four resolutions, from `fewest` steps on, extrapolated to steps of length zero. In
/// long double, so that rounding hardly reaches the fifth-order method.
template <class State, class Input, class Step, class History>
double measured_order(const State& state, const Input& input, long double duration, Step step,
                      const History& history, int fewest = 200) {
  std::vector<std::vector<long double>> ends;
  for (const int times : {1, 2, 4, 8})
    ends.push_back(after(state, input, duration, times * fewest, step, history));
  const auto slope = [&ends](std::size_t i) {
    return std::log2(distance(ends[i], ends[i + 1]) / distance(ends[i + 1], ends[i + 2]));
  };
  return double(2 * slope(1) - slope(0));
}

}  // namespace jourdain::tests
