// The emitted pendulum and double pendulum against exact and published solutions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "agreement/compiled_batch.hpp"
#include "agreement/exact_pendulum.hpp"
#include "agreement/shared_data.hpp"

namespace jourdain::tests {
namespace {

Sample start(const model::Mechanism& mechanism) {
  const reference::Reference<double> reference(mechanism);
  const auto state = reference.initial_state();
  Sample sample;
  for (const model::Parameter& parameter : mechanism.parameters) sample.parameters.push_back(parameter.value);
  sample.y.assign(state.y.begin(), state.y.end());
  sample.z.assign(state.z.begin(), state.z.end());
  sample.zdot.resize(sample.z.size(), 0.0);
  sample.u.resize(mechanism.actuators.size(), 0.0);
  return sample;
}

/// State after `steps` steps of length h.
Sample stepped(const CompiledBatch& batch, Sample sample, double h, int steps) {
  for (int i = 0; i < steps; ++i) {
    const Evaluation e = batch.evaluate(0, sample, h);
    sample.y = e.y_next;
    sample.z = e.z_next;
  }
  return sample;
}

/// Largest error of the angle at the steps of a run over 2 s.
double largest_error(const CompiledBatch& batch, Sample sample, int steps) {
  const long double h = 2.0L / steps;
  double worst = 0;
  for (int i = 1; i <= steps; ++i) {
    sample = stepped(batch, sample, double(h), 1);
    worst = larger_error(worst, std::fabs(double(sample.y[0] - exact_pendulum_angle(i * h))));
  }
  return worst;
}

TEST(Pendulum, FollowsItsExactSolutionWithOrderFour) {
  const Derived derived = derive(read_model(model_path("pendulum.toml")));
  const CompiledBatch batch({emit_model(derived, "pendulum")}, "g++", "double", {"-O2"});
  double previous = 0;
  fmt::print("pendulum over 2 s\n{:>10} {:>20} {:>8}\n", "h", "largest error, rad", "ratio");
  for (int steps = 50; steps <= 3200; steps *= 2) {
    const double error = largest_error(batch, start(derived.mechanism), steps);
    fmt::print("{:>10g} {:>20.4e} {:>8.2f}\n", 2.0 / steps, error, previous / error);
    if (steps >= 400) {
      EXPECT_GT(previous / error, 15.5);
      EXPECT_LT(previous / error, 16.5);
    }
    previous = error;
  }
}

TEST(Pendulum, AgreesWithThePublishedTrajectory) {
  std::ifstream file(data_path("reference/pendulum.csv"));
  const Derived derived = derive(read_model(model_path("pendulum.toml")));
  const CompiledBatch batch({emit_model(derived, "pendulum")}, "g++", "double", {"-O2"});
  Sample sample = start(derived.mechanism);
  std::string line;
  std::getline(file, line);
  double worst = 0;
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    double t = 0, x = 0, y = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &t, &x, &y), 3);
    if (rows > 0) sample = stepped(batch, sample, 1e-3, 100);
    worst = std::max(worst, std::hypot(std::sin(sample.y[0]) - x, -std::cos(sample.y[0]) - y));
  }
  EXPECT_EQ(rows, 101);
  EXPECT_LT(worst, 1e-9);  // RK4 at h = 1 ms: the table above
}

TEST(DoublePendulum, AgreesWithThePublishedStates) {
  std::ifstream file(data_path("reference/spring_and_double_pendulum.json"));
  const nlohmann::json cases = nlohmann::json::parse(file);
  const Derived derived = derive(read_model(model_path("double_pendulum.toml")));
  const CompiledBatch batch({emit_model(derived, "double_pendulum")}, "g++", "double", {"-O2"});
  for (const int t : {1, 5, 10}) {
    const nlohmann::json& expected = cases[fmt::format("double_pendulum_t{}", t)];
    const auto number = [&](const char* key) { return std::stod(expected[key].get<std::string>()); };
    const Sample end = stepped(batch, start(derived.mechanism), 2.5e-4, 4000 * t);
    // Published angles are absolute, ours relative; the motion is chaotic, so that errors grow with t.
    const double tolerance = t < 10 ? 1e-9 : 1e-8;
    EXPECT_NEAR(end.y[0], number("th1"), tolerance) << t;
    EXPECT_NEAR(end.y[0] + end.y[1], number("th2"), tolerance) << t;
    EXPECT_NEAR(end.z[0], number("w1"), tolerance) << t;
    EXPECT_NEAR(end.z[0] + end.z[1], number("w2"), tolerance) << t;
  }
}

}  // namespace
}  // namespace jourdain::tests
