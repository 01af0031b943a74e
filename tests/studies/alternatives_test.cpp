// Integrators that choose their own steps, and their comparison with the recommended one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "studies/alternatives.hpp"
#include "studies/cvode.hpp"
#include "studies/dormand_prince.hpp"
#include "studies/judged.hpp"
#include "studies/tables.hpp"

namespace jourdain::tests {
namespace {

constexpr double kEnd = 6;
constexpr long kNoLimit = 1000000000;

/// A push of cos 2t.
class Pushed : public Inputs {
 public:
  std::vector<double> at(double t) const override { return {std::cos(2 * t)}; }
  std::vector<LongReal> at(const LongReal& t) const override { return {cos(LongReal(2.0) * t)}; }
};

/// y of y'' = −y + cos 2t from 1 at rest.
double exact(double t) { return std::cos(t) + (std::cos(t) - std::cos(2 * t)) / 3; }

std::vector<double> dense_times() {
  std::vector<double> times;
  for (int k = 1; k <= 600; ++k) times.push_back(kEnd * k / 600);
  return times;
}

template <class Make>
AdaptiveRun pushed_run(double tolerance, const std::vector<double>& times, Make&& make) {
  const Pushed push;
  const Flow<double> flow(oscillator(0.0), push);
  CountedRates rates(flow);
  const auto integrator = make(rates, flow.start(), tolerance);
  AdaptiveRun run = follow(*integrator, rates, times, tolerance, kNoLimit);
  EXPECT_TRUE(run.finished);
  EXPECT_EQ(run.calls, rates.calls());
  return run;
}

AdaptiveRun by_dormand_prince(double tolerance, const std::vector<double>& times) {
  return pushed_run(tolerance, times, [](CountedRates& rates, const Point<double>& start, double own) {
    return std::make_unique<DormandPrince>(rates, start, kEnd, own);
  });
}

double largest_error(const AdaptiveRun& run) {
  double largest = 0;
  for (const Point<double>& point : run.points)
    largest = std::max(largest, std::fabs(point.x[0] - exact(point.t)));
  return largest;
}

TEST(DormandPrince, ErrsAsItsToleranceSaysEndsAndBetweenSteps) {
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const AdaptiveRun run = by_dormand_prince(tolerance, dense_times());
    EXPECT_LT(largest_error(run), 5 * tolerance) << tolerance;
    EXPECT_LT(std::fabs(run.points.back().x[0] - exact(kEnd)), 5 * tolerance) << tolerance;
  }
}

TEST(DormandPrince, HasOrderFive) {
  // The estimated error of a step is of order h⁵: a tolerance 1e5 times tighter takes ten times as many steps.
  const AdaptiveRun coarse = by_dormand_prince(1e-7, {kEnd}), fine = by_dormand_prince(1e-12, {kEnd});
  EXPECT_NEAR(double(fine.steps) / double(coarse.steps), 10, 1);
  const double gain = largest_error(coarse) / largest_error(fine);
  EXPECT_GT(std::log(gain) / std::log(double(fine.steps) / double(coarse.steps)), 4.5);
}

TEST(DormandPrince, CallsSixTimesForEachAttemptAndTwiceToStart) {
  const AdaptiveRun run = by_dormand_prince(1e-8, {kEnd});
  EXPECT_EQ((run.calls - 2) % 6, 0);
  EXPECT_GE(run.calls, 2 + 6 * run.steps);
  EXPECT_GE(run.worst_calls, 8);
}

TEST(DormandPrince, InterpolatingChangesNoStep) {
  const AdaptiveRun sparse = by_dormand_prince(1e-7, {kEnd}), dense = by_dormand_prince(1e-7, dense_times());
  EXPECT_EQ(sparse.steps, dense.steps);
  EXPECT_EQ(sparse.calls, dense.calls);
  EXPECT_EQ(sparse.points.back().x, dense.points.back().x);
}

TEST(Cvode, StepsOfItsOwnAreInterpolated) {
  for (const CvodeKind kind : {CvodeKind::kAdams, CvodeKind::kBdf}) {
    const AdaptiveRun run = pushed_run(
        1e-8, dense_times(), [kind](CountedRates& rates, const Point<double>& start, double tolerance) {
          return make_cvode(kind, rates, start, kEnd, tolerance);
        });
    EXPECT_LT(largest_error(run), 1e-6);
    EXPECT_LT(run.steps, 600);
    EXPECT_GT(run.worst_calls, 1);
  }
}

/// The spring pendulum with a recommendation, and what is beside it.
struct Compared {
  EmittedModel model;
  ConstantInputs none{{}};
  Flow<double> flow{model.table(), none};
  ReferenceSolution reference;
  WorkPrecision work;
  Advice advice;

  Compared(const std::string& name, const std::vector<std::string>& functions)
      : model(emitted_model(name, functions)),
        reference(solve_reference(flow, nullptr, ReferenceKind::kCvode, kSampling, 64, 1, 1, kSilent)),
        work(study_work_precision(flow, {kSampling, kSampling / 2, kSampling / 4, kSampling / 8}, kSampling,
                                  reference, false, {}, kSilent)),
        advice(*advise({1e-6, {}}, work, flow, kSampling, reference, {})) {}

  Alternatives study(std::optional<double> tolerance) {
    return study_alternatives(flow, advice, tolerance, kSampling, reference, 1, kSilent);
  }

  static constexpr double kSampling = 0.015625;
};

const std::vector<std::string> kFunctions = {"initial_state",
                                             "forward_dynamics",
                                             "position_rate",
                                             "inverse_dynamics",
                                             "kinetic_energy",
                                             "potential_energy",
                                             "rk4_step",
                                             "rk5_step",
                                             "semi_implicit_euler_step",
                                             "constraint_residual",
                                             "close_loops",
                                             "project"};

TEST(Alternatives, KeepTheErrorAtTheLoosestTolerance) {
  Compared scene("spring_pendulum", kFunctions);
  const Alternatives study = scene.study(1e-6);
  ASSERT_EQ(study.rows.size(), 5u);
  EXPECT_EQ(study.error, 1e-6);
  const Alternative& own = study.rows[1];
  ASSERT_TRUE(own.tolerance && own.keeps);
  const auto error_with = [&scene](double tolerance) {
    CountedRates rates(scene.flow);
    const Point<double> start = scene.flow.start();
    DormandPrince integrator(rates, start, scene.reference.points.back().t, tolerance);
    double largest = 0;
    for (const Point<double>& exact : scene.reference.points) {
      if (exact.t == start.t) continue;
      while (integrator.time() < exact.t) EXPECT_TRUE(integrator.step());
      std::vector<double> x(scene.flow.size());
      integrator.interpolate(exact.t, x.data());
      for (std::size_t i = 0; i < scene.flow.position_count(); ++i)
        largest = std::max(largest, std::fabs(x[i] - exact.x[i]));
    }
    return largest;
  };
  // The reference has points between those that are compared.
  EXPECT_LT(error_with(*own.tolerance), 1.2e-6);
  EXPECT_GT(error_with(*own.tolerance * std::cbrt(10.0)), 1e-6);
}

TEST(Alternatives, CountsRepeatAndTimesAreOrdered) {
  Compared scene("spring_pendulum", kFunctions);
  const Alternatives once = scene.study(1e-6), again = scene.study(1e-6);
  ASSERT_EQ(once.rows.size(), again.rows.size());
  for (std::size_t i = 0; i < once.rows.size(); ++i) {
    const Alternative &a = once.rows[i], &b = again.rows[i];
    EXPECT_EQ(a.steps, b.steps) << a.name;
    EXPECT_EQ(a.calls, b.calls) << a.name;
    EXPECT_EQ(a.worst_calls, b.worst_calls) << a.name;
    EXPECT_EQ(a.error.position, b.error.position) << a.name;
    EXPECT_EQ(a.tolerance, b.tolerance) << a.name;
    EXPECT_GT(a.run_time.least, 0) << a.name;
    EXPECT_LE(a.run_time.least, a.run_time.lower_quartile) << a.name;
    EXPECT_LE(a.run_time.lower_quartile, a.run_time.upper_quartile) << a.name;
    EXPECT_GE(a.calls, a.steps) << a.name;
    EXPECT_GE(a.worst_calls * a.steps, a.calls) << a.name;
  }
  EXPECT_EQ(time_ratio(once, once.rows.front()), 1);
}

TEST(Alternatives, WithoutAToleranceTheRecommendedErrorIsAskedFor) {
  Compared scene("spring_pendulum", kFunctions);
  const Alternatives study = scene.study({});
  EXPECT_EQ(study.error, scene.advice.error.position);
  EXPECT_TRUE(study.rows[1].keeps);
}

TEST(Alternatives, WhatDoesNotReachTheErrorSaysSo) {
  Compared scene("spring_pendulum", kFunctions);
  const Alternatives study =
      study_alternatives(scene.flow, scene.advice, 1e-6, Compared::kSampling, scene.reference, 2e-6, kSilent);
  for (std::size_t i = 1; i <= 3; ++i) EXPECT_FALSE(study.rows[i].keeps) << study.rows[i].name;
  const Alternative engine = scene.study(1e-6).rows.back();
  ASSERT_TRUE(engine.h && engine.finished);
  EXPECT_NEAR(*engine.h, 2e-3, 1e-4);
  EXPECT_FALSE(engine.keeps);
  EXPECT_GT(engine.error.position, 1e-6);
}

TEST(Alternatives, LoopsAreKeptClosed) {
  Compared scene("n_four_bar", kFunctions);
  const Alternatives study = scene.study(1e-6);
  for (std::size_t i = 0; i <= 3; ++i) EXPECT_TRUE(study.rows[i].keeps) << study.rows[i].name;
}

}  // namespace
}  // namespace jourdain::tests
