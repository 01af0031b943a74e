// Errors that a report states, against an integration of its own of the emitted code, which knows nothing of the studies: the classical
// Runge-Kutta method in long double on the emitted accelerations.
#ifndef JOURDAIN_SANITIZED  // long runs

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cart_pole_all/cart_pole_all_kernels.hpp"
#include "crane_all/crane_all_kernels.hpp"
#include "double_pendulum_all/double_pendulum_all_kernels.hpp"
#include "elastic_arm_all/elastic_arm_all_kernels.hpp"
#include "flyball_governor_all/flyball_governor_all_kernels.hpp"
#include "hoop_bead_all/hoop_bead_all_kernels.hpp"
#include "quadrotor_all/quadrotor_all_kernels.hpp"
#include "slider_crank_all/slider_crank_all_kernels.hpp"
#include "spring_four_bar_all/spring_four_bar_all_kernels.hpp"
#include "spring_pendulum_all/spring_pendulum_all_kernels.hpp"
#include "steppers/visit_steppers.hpp"
#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::tests {
namespace {

using Long = long double;
using nlohmann::json;

constexpr double kDuration = 2, kSampling = 0.016;  // s, as the report has them unasked
constexpr double kTolerance = 1e-6;                 // rad, m
constexpr double kKept = 0.0005;                    // s between the points of a solution that are kept

/// A solution as cubics between points.
struct Solution {
  std::vector<std::vector<Long>> y, ydot;
  double error = 0;  ///< difference to a run with steps twice as long, at the points

  Long at(double t, std::size_t i) const {
    const auto k = std::min(static_cast<std::size_t>(t / kKept), y.size() - 2);
    const Long s = (t - static_cast<Long>(k) * kKept) / kKept, r = 1 - s;
    return r * r * ((1 + 2 * s) * y[k][i] + s * kKept * ydot[k][i]) +
           s * s * ((1 + 2 * r) * y[k + 1][i] - r * kKept * ydot[k + 1][i]);
  }
};

template <class State>
struct Rates {
  Long y[std::size(decltype(State::y){})], z[std::size(decltype(State::z){})];
};

template <class Model, class State>
Rates<State> rates(const Model& model, const State& state) {
  Rates<State> f;
  forward_dynamics(model, state, typename Model::Input{}, f.z);
  if constexpr (requires { position_rate(model, state, f.y); })
    position_rate(model, state, f.y);
  else
    std::copy(std::begin(state.z), std::end(state.z), f.y);
  return f;
}

template <class Model, class State>
State moved(const Model& model, const State& state, const Rates<State>& f, Long h) {
  State result = state;
  for (std::size_t i = 0; i < std::size(f.y); ++i) result.y[i] += h * f.y[i];
  for (std::size_t i = 0; i < std::size(f.z); ++i) result.z[i] += h * f.z[i];
  if constexpr (requires { result.t; }) result.t += h;
  if constexpr (requires { close_loops(model, result); }) close_loops(model, result);
  return result;
}

/// `steps` to each point that is kept.
template <class Model>
Solution solved(const Model& model, int steps) {
  Solution solution;
  auto state = initial_state(model);
  const Long h = static_cast<Long>(kKept) / steps;
  for (long k = 0; k <= std::lround((kDuration + 2 * kKept) / kKept); ++k) {
    const auto now = rates(model, state);
    solution.y.emplace_back(std::begin(state.y), std::end(state.y));
    solution.ydot.emplace_back(std::begin(now.y), std::end(now.y));
    for (int i = 0; i < steps; ++i) {
      const auto k1 = rates(model, state), k2 = rates(model, moved(model, state, k1, h / 2)),
                 k3 = rates(model, moved(model, state, k2, h / 2)),
                 k4 = rates(model, moved(model, state, k3, h));
      auto sum = k1;
      for (std::size_t j = 0; j < std::size(sum.y); ++j)
        sum.y[j] = (k1.y[j] + 2 * (k2.y[j] + k3.y[j]) + k4.y[j]) / 6;
      for (std::size_t j = 0; j < std::size(sum.z); ++j)
        sum.z[j] = (k1.z[j] + 2 * (k2.z[j] + k3.z[j]) + k4.z[j]) / 6;
      state = moved(model, state, sum, h);
    }
  }
  return solution;
}

template <class Model>
Solution solved(const Model& model) {
  constexpr int kSteps = 64;
  Solution solution = solved(model, kSteps);
  const Solution coarse = solved(model, kSteps / 2);
  for (std::size_t k = 0; k < solution.y.size(); ++k)
    for (std::size_t i = 0; i < solution.y[k].size(); ++i)
      solution.error =
          std::max(solution.error, static_cast<double>(std::fabs(solution.y[k][i] - coarse.y[k][i])));
  return solution;
}

/// Largest position error of a run at multiples of `interval`; infinite where it fails.
template <class State, class Input, class Step, class History>
double run_error(State state, const Input& input, Step step, History history, double h, double interval,
                 const Solution& exact) {
  double largest = 0;
  const long steps = std::lround(kDuration / h), stride = std::lround(interval / h);
  for (long k = 1; k <= steps; ++k) {
    step(state, input, h, history);
    if (k % stride != 0) continue;
    for (std::size_t i = 0; i < std::size(state.y); ++i) {
      const auto error = static_cast<double>(std::fabs(state.y[i] - exact.at(static_cast<double>(k) * h, i)));
      if (!(error < 1e3)) return INFINITY;
      largest = std::max(largest, error);
    }
  }
  return largest;
}

json report_on(const std::string& name) {
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      support::run_process({JOURDAIN_BINARY, "report", JOURDAIN_SOURCE_DIR "/models/" + name + ".toml",
                            "--duration", "2s", "--effort", "0.3", "--no-plots", "--no-forms", "--tolerance",
                            fmt::format("{}", kTolerance), "-o", folder.path() + "/out"});
  EXPECT_EQ(result.status, 0) << result.output;
  return json::parse(support::read_file(folder.path() + "/out/report.json"));
}

/// What is stated of the point; infinite where it fails.
double stated_error(const json& report, const std::string& method, double h) {
  for (const json& point : report["points"])
    if (point["method"] == method && std::fabs(point["step_s"].get<double>() - h) < 1e-9)
      return point["finite"].get<bool>() ? point["largest"]["position"].get<double>() : INFINITY;
  ADD_FAILURE() << "no point of " << method << " at " << h;
  return 0;
}

#define JOURDAIN_TEST_STATED_ERRORS(name)                                                            \
  TEST(StatedErrors, name) {                                                                         \
    const json report = report_on(#name);                                                            \
    const Solution exact = solved(::name##_all::Model<Long>());                                      \
    EXPECT_LT(exact.error, 1e-11);                                                                   \
    EXPECT_EQ(report["judged_s"], report["duration_s"]);                                             \
    const auto start = initial_state(::name##_all::Model<double>());                                 \
    const ::name##_all::Input<double> without{};                                                     \
    const json& advice = report["recommendation"];                                                   \
    const double reference_error = report["reference"]["error"];                                     \
    int compared = 0, advised = 0;                                                                   \
    const auto visit = [&](const std::string& method, int, auto step, auto& history) {               \
      for (const double h : {0.016, 0.008, 0.002}) {                                                 \
        const double stated = stated_error(report, method, h);                                       \
        const double seen = run_error(start, without, step, history, h, kSampling, exact);           \
        EXPECT_EQ(std::isfinite(stated), std::isfinite(seen)) << method << " " << h;                 \
        if (!std::isfinite(seen)) continue;                                                          \
        EXPECT_NEAR(stated, seen, 1e-3 * seen + 2e-10 + 10 * reference_error) << method << " " << h; \
        compared += seen > 1e-7;                                                                     \
      }                                                                                              \
      if (advice["method"] != method) return;                                                        \
      const double h = advice["step_s"];                                                             \
      EXPECT_LE(run_error(start, without, step, history, h, h, exact), 1.001 * kTolerance)           \
          << method << " " << h;                                                                     \
      ++advised;                                                                                     \
    };                                                                                               \
    JOURDAIN_VISIT_STEPPERS(name##_all, double, visit);                                              \
    EXPECT_GE(compared, 5);                                                                          \
    EXPECT_EQ(advised, 1);                                                                           \
  }

JOURDAIN_TEST_STATED_ERRORS(cart_pole)
JOURDAIN_TEST_STATED_ERRORS(crane)
JOURDAIN_TEST_STATED_ERRORS(double_pendulum)
JOURDAIN_TEST_STATED_ERRORS(elastic_arm)
JOURDAIN_TEST_STATED_ERRORS(flyball_governor)
JOURDAIN_TEST_STATED_ERRORS(hoop_bead)
JOURDAIN_TEST_STATED_ERRORS(quadrotor)
JOURDAIN_TEST_STATED_ERRORS(slider_crank)
JOURDAIN_TEST_STATED_ERRORS(spring_four_bar)
JOURDAIN_TEST_STATED_ERRORS(spring_pendulum)

}  // namespace
}  // namespace jourdain::tests

#endif
