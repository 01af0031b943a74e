// Runs of an emitted model against a solution of its own: collocation at six Gauss points (order 12) in long double, by
// fixed-point iteration, with steps halved until two solutions agree. It uses what the emitted header
// declares, and nothing of this project beside.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace audit {

using Long = long double;

/// Nodes cᵢ in [0, 1], weights bᵢ and aᵢⱼ = ∫₀^cᵢ ℓⱼ of Gauss collocation.
struct Gauss {
  static constexpr int kStages = 6;
  std::array<Long, kStages> c{}, b{};
  std::array<std::array<Long, kStages>, kStages> a{};

  Gauss() {
    const Long pi = std::acos(Long(-1));
    for (int i = 0; i < kStages; ++i) {
      Long x = -std::cos(pi * (i + Long(0.75)) / (kStages + Long(0.5)));
      for (int k = 0; k < 50; ++k) x -= legendre(x) / slope(x);
      c[i] = (1 + x) / 2;
      b[i] = 1 / ((1 - x * x) * slope(x) * slope(x));
    }
    // The rule itself integrates the polynomials ℓⱼ without error.
    for (int i = 0; i < kStages; ++i)
      for (int j = 0; j < kStages; ++j)
        for (int k = 0; k < kStages; ++k) a[i][j] += c[i] * b[k] * lagrange(j, c[i] * c[k]);
  }

 private:
  static Long legendre(Long x) {
    Long before = 1, p = x;
    for (int k = 2; k <= kStages; ++k) {
      const Long next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
      before = p;
      p = next;
    }
    return p;
  }
  static Long slope(Long x) {
    Long before = 1, p = x;
    for (int k = 2; k < kStages; ++k) {
      const Long next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
      before = p;
      p = next;
    }
    return kStages * (p - x * legendre(x)) / (1 - x * x);
  }
  Long lagrange(int j, Long x) const {
    Long product = 1;
    for (int k = 0; k < kStages; ++k)
      if (k != j) product *= (x - c[k]) / (c[j] - c[k]);
    return product;
  }
};

/// Positions and velocities of a model in long double, and their rates.
template <template <class> class Model>
class System {
 public:
  using State = typename Model<Long>::State;
  static constexpr int ny = Model<Long>::position_count, nz = Model<Long>::velocity_count;
  using Vector = std::array<Long, ny + nz>;

  Vector start() const {
    State state = initial_state(model_);
    return closed(state);
  }
  Vector closed(const Vector& x, Long t) const {
    State state = at(x, t);
    return closed(state);
  }
  Vector rates(const Vector& x, Long t) const {
    State state = at(x, t);
    if constexpr (requires { close_loops(model_, state); }) close_loops(model_, state);
    Long y[ny], z[nz];
    if constexpr (requires { position_rate(model_, state, y); })
      position_rate(model_, state, y);
    else
      std::copy(state.z, state.z + std::min(ny, nz), y);
    forward_dynamics(model_, state, input_, z);
    Vector rate;
    std::copy(y, y + ny, rate.begin());
    std::copy(z, z + nz, rate.begin() + ny);
    return rate;
  }

 private:
  State at(const Vector& x, Long t) const {
    State state = initial_state(model_);
    if constexpr (requires { state.t; }) state.t = t;
    std::copy(x.begin(), x.begin() + ny, state.y);
    std::copy(x.begin() + ny, x.end(), state.z);
    return state;
  }
  Vector closed(State& state) const {
    if constexpr (requires { close_loops(model_, state); }) close_loops(model_, state);
    Vector x;
    std::copy(state.y, state.y + ny, x.begin());
    std::copy(state.z, state.z + nz, x.begin() + ny);
    return x;
  }

  Model<Long> model_;
  typename Model<Long>::Input input_{};
};

/// One step of collocation; false where the iteration does not converge.
template <template <class> class Model>
bool step(const System<Model>& system, const Gauss& gauss, Long t, Long h,
          typename System<Model>::Vector& x) {
  constexpr int kMostIterations = 100;
  constexpr Long kConverged = 4 * std::numeric_limits<Long>::epsilon();
  typename System<Model>::Vector k[Gauss::kStages];
  for (auto& stage : k) stage = system.rates(x, t);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    Long change = 0;
    for (int i = 0; i < Gauss::kStages; ++i) {
      auto stage = x;
      for (std::size_t e = 0; e < x.size(); ++e)
        for (int j = 0; j < Gauss::kStages; ++j) stage[e] += h * gauss.a[i][j] * k[j][e];
      const auto next = system.rates(stage, t + gauss.c[i] * h);
      for (std::size_t e = 0; e < x.size(); ++e)
        change = std::max(change, h * std::fabs(next[e] - k[i][e]) / (1 + std::fabs(x[e])));
      k[i] = next;
    }
    if (!(change < 1e3L)) return false;
    if (change > kConverged && iteration + 1 < kMostIterations) continue;
    if (change > 1e3L * kConverged) return false;
    for (std::size_t e = 0; e < x.size(); ++e)
      for (int i = 0; i < Gauss::kStages; ++i) x[e] += h * gauss.b[i] * k[i][e];
    return true;
  }
  return false;
}

/// Closed states at 0, interval, 2 interval, …; empty where a step does not converge.
template <template <class> class Model>
std::vector<typename System<Model>::Vector> solution(Long interval, long count, long steps) {
  const System<Model> system;
  const Gauss gauss;
  auto x = system.start();
  std::vector points{x};
  for (long i = 0; i < count; ++i) {
    for (long k = 0; k < steps; ++k)
      if (!step<Model>(system, gauss, (i + Long(k) / steps) * interval, interval / steps, x)) return {};
    x = system.closed(x, (i + 1) * interval);
    points.push_back(x);
  }
  return points;
}

/// Largest difference of positions.
template <class A, class B>
Long difference(const A& a, const B& b, int positions) {
  Long largest = 0;
  for (int i = 0; i < positions; ++i)
    if (!(std::fabs(a[i] - b[i]) <= largest)) largest = std::fabs(a[i] - b[i]);
  return largest;
}

/// Reference at every `interval` (s), and what two solutions differ by.
template <template <class> class Model>
std::vector<typename System<Model>::Vector> reference(Long interval, long count, Long& known_to) {
  constexpr Long kKnown = 1e-13L;
  constexpr long kMostSteps = 512;
  std::vector<typename System<Model>::Vector> before;
  for (long steps = 1; steps <= kMostSteps; steps *= 2) {
    auto points = solution<Model>(interval, count, steps);
    if (!points.empty() && !before.empty()) {
      known_to = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        known_to = std::max(known_to, difference(points[i], before[i], System<Model>::ny));
      if (known_to < kKnown) return points;
    }
    before = std::move(points);
  }
  return {};
}

/// Arguments: intervals, their length (s), then method, h (s), steps and intervals between two comparisons,
/// and so on. Prints the largest difference of a position for each: of the emitted steps in double, as the
/// header says that they are called.
template <template <class> class Model, class Accelerations, template <int, class> class RateHistory>
int run(int count, char** arguments) {
  const long intervals = std::stol(arguments[1]);
  const Long interval = std::stold(arguments[2]);
  Long known_to = 0;
  const auto exact = reference<Model>(interval, intervals, known_to);
  if (exact.empty()) return 1;
  std::printf("%.3Le\n", known_to);
  for (int i = 3; i + 3 < count; i += 4) {
    const std::string method = arguments[i];
    const double h = std::stod(arguments[i + 1]);
    const long steps = std::stol(arguments[i + 2]), stride = std::stol(arguments[i + 3]);
    const Model<double> model;
    const typename Model<double>::Input input{};
    typename Model<double>::State state = initial_state(model);
    Accelerations accelerations{};
    RateHistory<1, double> one{};
    RateHistory<2, double> two{};
    Long largest = 0;
    for (long at = stride; at <= intervals; at += stride) {
      for (long k = 0; k < steps; ++k) {
        if (method == "euler") euler_step(model, state, input, h);
        if (method == "semi_implicit_euler") semi_implicit_euler_step(model, state, input, h);
        if (method == "heun") heun_step(model, state, input, h);
        if (method == "rk4") rk4_step(model, state, input, h);
        if (method == "rk5") rk5_step(model, state, input, h);
        if (method == "adams_bashforth2") adams_bashforth2_step(model, state, input, h, one);
        if (method == "adams_bashforth3") adams_bashforth3_step(model, state, input, h, two);
        if (method == "linearly_implicit_euler")
          linearly_implicit_euler_step(model, state, input, h, accelerations);
        if (method == "ros34pw2") ros34pw2_step(model, state, input, h, accelerations);
        if (method == "rosw43") rosw43_step(model, state, input, h, accelerations);
        if (method == "rodas4") rodas4_step(model, state, input, h, accelerations);
      }
      const Long now = difference(state.y, exact[at], System<Model>::ny);
      if (!(now <= largest)) largest = now;
      if (!std::isfinite(largest)) break;
    }
    std::printf("%.17Lg\n", largest);
  }
  return 0;
}

}  // namespace audit
