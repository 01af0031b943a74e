// Stiff models: limits that are predicted against those that runs show, and the implicit steppers at many
// times RK4's limit.
#include <fmt/format.h>

#include <cmath>

#include "agreement/shared_data.hpp"
#include "commands/build_model.hpp"
#include "compile/articulation.hpp"
#include "studies/judged.hpp"
#include "studies/report.hpp"

namespace jourdain::tests {
namespace {

#ifndef JOURDAIN_SANITIZED  // runs by the million are too slow there

/// A model with one of its parameters, over a time (s) that its fast mode fills with a few hundred periods.
struct StiffCase {
  const char* model;
  const char* parameter;
  double value, duration;
  bool conserves = false;
  bool observes_euler = true;  ///< its deciding mode grows fast enough beyond the limit for runs to show it
};

void PrintTo(const StiffCase& c, std::ostream* out) {
  *out << fmt::format("{} {}={:g}", c.model, c.parameter, c.value);
}

class StiffModels : public ::testing::TestWithParam<StiffCase> {};

TEST_P(StiffModels, DivergeAtThePredictedStepsOfEulerAndRk4) {
  constexpr long kIntervals = 16;
  const StiffCase& c = GetParam();
  const auto functions = commands::loadable_functions({"euler", "rk4", "rk5"});
  EmittedModel model = c.model == std::string("bushing_chain")
                           ? emitted_from(bushing_chain_text(20), functions)
                           : emitted_model(c.model, functions);
  model.set_parameter(c.parameter, c.value);
  const Judged judged(std::move(model), kIntervals, c.conserves, c.duration / kIntervals);
  for (const char* method : {"euler", "rk4"}) {
    const MethodLimit& limit = judged.limit(method);
    fmt::print("{:<16} {} = {:<6g} {:<6} predicted {:<10} observed {:<10} mode {}\n", c.model, c.parameter,
               c.value, method, limit_text(limit),
               limit.observed ? fmt::format("{:.4g} s", limit.observed->h) : "-", mode_text(limit.mode));
    if (limit.h > 0 && (c.observes_euler || method != std::string("euler"))) judged.expect_observed(method);
  }
  if (c.conserves) {
    EXPECT_EQ(judged.limit("euler").h, 0);
    EXPECT_NEAR(judged.limit("rk4").h * std::abs(judged.limit("rk4").mode), std::sqrt(8.0), 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Limits, StiffModels,
    ::testing::Values(StiffCase{"spring_pendulum", "k", 1e4, 0.5, true},
                      StiffCase{"spring_pendulum", "k", 1e6, 0.2, true},
                      StiffCase{"spring_pendulum", "k", 1e8, 0.05, true},
                      StiffCase{"spring_pendulum", "k", 1e10, 0.1, true},
                      StiffCase{"spring_pendulum", "k", 1e12, 3e-3, true},
                      StiffCase{"elastic_arm", "k", 1e3, 1}, StiffCase{"elastic_arm", "k", 1e6, 0.1},
                      StiffCase{"elastic_arm", "k", 1e9, 3e-3}, StiffCase{"contact_wheel", "k", 1e7, 0.5},
                      StiffCase{"contact_wheel", "k", 3e7, 0.2}, StiffCase{"spring_joint", "k", 1e4, 0.5},
                      StiffCase{"spring_joint", "k", 1e8, 0.01},
                      StiffCase{"bushing_chain", "k", 1e6, 0.02, false, false}));

#endif

TEST(BushingChain, IsSolvedThroughArticulatedBodies) {
  support::Diagnostics diagnostics("chain.toml", bushing_chain_text(20));
  const auto chain = model::read_mechanism(diagnostics);
  ASSERT_TRUE(chain);
  EXPECT_LE(choose_articulation(*chain, {}).operations, 3525u);  // 88482 by factoring M
}

/// Largest differences along the way.
struct Differences {
  double position = 0, velocity = 0;
};

/// Positions and velocities at `count` times of a run of `method`.
std::vector<std::vector<double>> sampled(const Flow<double>& flow, const char* method, double h, long steps,
                                         long count) {
  const jourdain_method& m = flow.table().methods[method_called(flow.table(), method)];
  Point<double> point = flow.start();
  Memory memory = flow.fresh_memory(m);
  std::vector<std::vector<double>> samples;
  for (long i = 0; i < count; ++i) {
    flow.step(m, point, h, steps, memory);
    samples.push_back(point.x);
  }
  return samples;
}

/// Of the link angles of the elastic arm: motor and spring together.
Differences of_links(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  Differences worst;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < 6; i += 2) {
      const auto link = [i](const std::vector<double>& x, std::size_t first) {
        return x[first + i] + x[first + i + 1];
      };
      worst.position = larger_error(worst.position, std::fabs(link(a[k], 0) - link(b[k], 0)));
      worst.velocity = larger_error(worst.velocity, std::fabs(link(a[k], 6) - link(b[k], 6)));
    }
  return worst;
}

/// 2 s of the arm at 20 times RK4's largest stable step, against explicit steps at a thirtieth of it.
class ElasticArm {
 public:
  ElasticArm(EmittedModel& model, double k, double damping_ratio, double deflection)
      : flow_(model.table(), none_) {
    model.set_parameter("k", k);
    model.set_parameter("damping_ratio", damping_ratio);
    std::vector<double> x = flow_.start().x;
    for (std::size_t i = 1; i < 6; i += 2) x[i] *= deflection;
    flow_.set_start(x);
    const double rk4 = kRk4Limit * std::sqrt(1e6 / k);
    count_ = long(2 / (20 * rk4));
    constexpr long kFiner = 400;
    exact_ = sampled(flow_, "rk5", step() / kFiner, kFiner, count_);
  }

  double step() const { return 2.0 / double(count_); }
  Differences error(const char* method) const {
    const Differences d = of_links(sampled(flow_, method, step(), 1, count_), exact_);
    fmt::print("  {:<23} h = {:.3g} s: link angles {:.1e} rad, velocities {:.1e} rad/s\n", method, step(),
               d.position, d.velocity);
    return d;
  }

 private:
  static constexpr double kRk4Limit = 2.588e-4;  // s, at k = 1e6 N m/rad; seen in the limits above
  ConstantInputs none_{{}};
  Flow<double> flow_;
  long count_ = 0;
  std::vector<std::vector<double>> exact_;
};

constexpr double kLinks = 1e-5;  // rad

#ifndef JOURDAIN_SANITIZED  // runs by the million are too slow there

TEST(ElasticArm, KeepsItsLinkAnglesAtTwentyTimesTheLimitOfRk4) {
  EmittedModel model = emitted_model("elastic_arm");
  for (const double k : {1e6, 1e9})
    for (const auto& [ratio, deflection] : {std::pair(0.05, 1.0), {0.05, 1.5}, {0.0, 1.5}}) {
      fmt::print("k = {:g} N m/rad, damping ratio {}, started at {} times the static deflection\n", k, ratio,
                 deflection);
      const ElasticArm arm(model, k, ratio, deflection);
      for (const char* method : {"ros34pw2", "rosw43", "rodas4"})
        EXPECT_LE(arm.error(method).position, kLinks) << method;
    }
}

/// Largest error of the governor's slider (m) over 10 s at every `interval` (s), against a run of rk5.
double slider_error(const Flow<double>& flow, const char* method, double h,
                    const std::vector<std::vector<double>>& exact, double interval) {
  const auto samples = sampled(flow, method, h, std::lround(interval / h), long(exact.size()));
  double worst = 0;
  for (std::size_t k = 0; k < exact.size(); ++k)
    worst = larger_error(worst, std::fabs(samples[k][1] - exact[k][1]));
  fmt::print("  {:<23} h = {:.3g} s: slider {:.1e} m\n", method, h, worst);
  return worst;
}

TEST(FlyballGovernor, KeepsItsSliderAtTwentyTimesTheLimitOfRk4) {
  EmittedModel model = emitted_model("flyball_governor");
  const ConstantInputs none{{}};
  const Flow<double> flow(model.table(), none);
  constexpr double kStep = 10.0 / 1450;  // 6.9e-3 s, over 20 times 3.43e-4 s
  const auto exact = sampled(flow, "rk5", kStep / 50, 50, 1450);
  EXPECT_LE(slider_error(flow, "rosw43", kStep, exact, kStep), 1e-5);
  EXPECT_LE(slider_error(flow, "rodas4", kStep, exact, kStep), 1e-5);
  EXPECT_LE(slider_error(flow, "ros34pw2", kStep, exact, kStep), 2e-5);  // 1e-5 at 17 times the limit
  constexpr double kShorter = 10.0 / 1740;
  EXPECT_LE(slider_error(flow, "ros34pw2", kShorter, sampled(flow, "rk5", kShorter / 50, 50, 1740), kShorter),
            1e-5);
}

constexpr const char* kTrueJoint = R"(
[model]
name = "true_joint"
gravity = [0, -9.81, 0]
[[body]]
name = "rod"
mass = 1.0
center_of_mass = [0.5, 0, 0]
shape = { kind = "rod", length = 1.0, axis = "x" }
[[joint]]
name = "hinge"
type = "revolute"
parent = "world"
child = "rod"
axis = [0, 0, 1]
)";

TEST(SpringJoint, TendsToTheTrueJointAndPaysForItInSteps) {
  constexpr double kDuration = 1,
                   kLimit = 5.85e-3;  // s; RK4's largest stable step at k = 1e4 N/m, seen in the limits above
  const ConstantInputs none{{}};
  const EmittedModel hinge = emitted_from(kTrueJoint);
  EmittedModel springs = emitted_model("spring_joint");
  const auto angle = [&](const EmittedModel& model, std::size_t entry, const char* method, long steps) {
    const Flow<double> flow(model.table(), none);
    return sampled(flow, method, kDuration / double(steps), steps, 1)[0][entry];
  };
  const auto operations = [](const EmittedModel& model, const char* method) {
    return double(model.table().methods[method_called(model.table(), method)].operations);
  };
  const double exact = angle(hinge, 0, "rk5", 4000);
  constexpr long kHingeSteps = 250;  // RK4 errs by less than 1e-7 rad
  double previous = 0;
  for (const double k : {1e4, 1e6, 1e8, 1e10}) {
    springs.set_parameter("k", k);
    const long steps = long(kDuration / (0.9 * kLimit * std::sqrt(1e4 / k)));
    const double difference = std::fabs(angle(springs, 2, "rk4", std::max(steps, 2000L)) - exact);
    fmt::print(
        "  k = {:<6g} N/m: off by {:.1e} rad, RK4 needs {} steps a second, {:.0f} times the operations of "
        "the true joint\n",
        k, difference, steps,
        double(steps) * operations(springs, "rk4") / (double(kHingeSteps) * operations(hinge, "rk4")));
    if (previous > 0 && k < 1e10) {
      EXPECT_NEAR(previous / difference, 100, 50) << k;  // inversely as the stiffness
    }
    previous = difference;
  }
  EXPECT_LE(std::fabs(angle(hinge, 0, "rk4", kHingeSteps) - exact), 1e-7);
}

#endif

}  // namespace
}  // namespace jourdain::tests
