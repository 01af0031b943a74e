// Parts of a study against an oscillator whose solution is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "model/read/read.hpp"
#include "studies/advice.hpp"
#include "studies/cvode.hpp"
#include "studies/driven_inputs.hpp"
#include "studies/error_sources.hpp"
#include "studies/extrapolation.hpp"
#include "studies/report.hpp"
#include "studies/sensitivity.hpp"
#include "studies/study.hpp"
#include "studies/tables.hpp"
#include "support/check.hpp"
#include "support/files.hpp"

namespace jourdain::tests {
namespace {

using namespace studies;

const Progress kSilent = [](const std::string&, double) {};
constexpr double kSampling = 0.0625;

TEST(LongReal, HasFiftyDigitsAndSplitsIntoDoublesWithoutLoss) {
  const LongReal third = LongReal(1.0) / LongReal(3.0);
  EXPECT_LT(std::fabs(double(third * LongReal(3.0) - LongReal(1.0))), 1e-50);
  const LongReal angle(0.7), one = sin(angle) * sin(angle) + cos(angle) * cos(angle);
  EXPECT_LT(std::fabs(double(one - LongReal(1.0))), 1e-50);
  for (const double turn : {-3.1, -1.0, 0.7, 2.5}) {
    const LongReal x(turn), back = atan2(sin(x), cos(x));
    EXPECT_LT(std::fabs(double(back - x)), 1e-49);
  }
  EXPECT_EQ(double(atan2(LongReal(0.0), LongReal(-1.0))), std::atan2(0.0, -1.0));
  EXPECT_EQ(double(atan2(LongReal(0.0), LongReal(1.0))), 0);
  EXPECT_EQ(double(atan2(LongReal(0.0), LongReal(0.0))), 0);
  double parts[4];
  third.split(parts, 4);
  EXPECT_EQ(double(LongReal::joined(parts, 4) - third), 0);
  EXPECT_EQ(parts[0], 1.0 / 3.0);
}

TEST(Extrapolation, GivesTheCosineToItsTolerance) {
  const NoForce none;
  const Flow<LongReal> flow(oscillator(LongReal()), none);
  const auto points = extrapolated(flow, flow.start(), 0.25, 8, {.tolerance = 1e-30});
  ASSERT_TRUE(points);
  for (const Point<LongReal>& point : *points) {
    EXPECT_LT(std::fabs(double(point.x[0] - cos(point.t))), 1e-29);
    EXPECT_LT(std::fabs(double(point.x[1] + sin(point.t))), 1e-29);
  }
}

TEST(Extrapolation, GivesUpWhereItsLimitWillBePassed) {
  const NoForce none;
  const Flow<LongReal> flow(oscillator(LongReal()), none);
  EXPECT_FALSE(extrapolated(flow, flow.start(), 0.25, 1000, {.tolerance = 1e-30, .evaluation_limit = 5000}));
}

TEST(Cvode, GivesTheCosine) {
  const NoForce none;
  const Flow<double> flow(oscillator(0.0), none);
  const auto points = solved_by_cvode(flow, flow.start(), 0.25, 8, 1e-12);
  ASSERT_TRUE(points);
  for (const Point<double>& point : *points) EXPECT_NEAR(point.x[0], std::cos(point.t), 1e-10);
}

/// A push that ends to be a number after a while.
class EndingForce : public studies::Inputs {
 public:
  explicit EndingForce(double end) : end_(end) {}
  std::vector<double> at(double t) const override { return {t < end_ ? 0 : NAN}; }
  std::vector<LongReal> at(const LongReal& t) const override { return {LongReal(at(double(t))[0])}; }

 private:
  double end_;
};

TEST(ReferenceSolution, IsNoneWhereRatesAreNoNumbers) {
  for (const double end : {0.0, 1.0}) {
    const EndingForce push(end);
    const Flow<double> flow(oscillator(0.0), push);
    const Flow<LongReal> long_flow(oscillator(LongReal()), push);
    EXPECT_FALSE(solved_by_cvode(flow, flow.start(), 0.25, 8, 1e-12)) << end;
    EXPECT_FALSE(extrapolated(long_flow, long_flow.start(), 0.25, 8, {.tolerance = 1e-30})) << end;
    EXPECT_THROW(solve_reference(flow, &long_flow, ReferenceKind::kAutomatic, kSampling, 32, 3, 2, kSilent),
                 support::EnvironmentError)
        << end;
  }
}

TEST(ReferenceSolution, StatesAnErrorThatCoversTheTrueOne) {
  const NoForce none;
  const Flow<double> flow(oscillator(0.0), none);
  const Flow<LongReal> long_flow(oscillator(LongReal()), none);
  const ReferenceSolution exact =
      solve_reference(flow, &long_flow, ReferenceKind::kAutomatic, kSampling, 32, 3, 2, kSilent);
  ASSERT_FALSE(exact.exact.empty());
  const Point<LongReal>& end = exact.exact.back();
  EXPECT_EQ(double(end.t), 2);
  EXPECT_LE(std::fabs(double(end.x[0] - cos(end.t))), exact.error + 1e-40);
  EXPECT_LT(exact.error, 1e-18);
  EXPECT_GT(exact.position_error, 0);
  EXPECT_LE(exact.position_error, 2 * exact.error);  // |x| is at most 1
  EXPECT_EQ(exact.digits, InFiftyDigits::kSolved);
  const ReferenceSolution cheap =
      solve_reference(flow, nullptr, ReferenceKind::kAutomatic, kSampling, 32, 3, 2, kSilent);
  EXPECT_TRUE(cheap.exact.empty());
  EXPECT_EQ(cheap.digits, InFiftyDigits::kTooCostly);
  EXPECT_EQ(solve_reference(flow, &long_flow, ReferenceKind::kCvode, kSampling, 32, 3, 2, kSilent).digits,
            InFiftyDigits::kNotTried);
  EXPECT_LE(std::fabs(cheap.points.back().x[0] - std::cos(2.0)), 20 * cheap.error + 1e-15);
}

TEST(Divergence, IsThatOfTheHyperbolicCosine) {
  const NoForce none;
  const Flow<double> flow(unstable(0.0), none);
  const ReferenceSolution reference =
      solve_reference(flow, nullptr, ReferenceKind::kCvode, 0.1, 40, 0, 1, kSilent);
  constexpr double kRate = 2;
  const Divergence divergence = measure_divergence(flow, reference.points, 0.1, kRate);
  ASSERT_EQ(divergence.growth.size(), 41u);
  // Whatever the direction, after a while separations grow as exp(5 t); its share of the growing mode costs a
  // constant factor.
  for (std::size_t k = 10; k < 40; ++k)
    EXPECT_NEAR(std::log(divergence.growth[k + 1] / divergence.growth[k]), 0.5, 1e-4) << k;
  const double most = std::hypot(std::cosh(20.0), kRate * std::sinh(20.0) / 5);
  EXPECT_LT(divergence.growth[40], 1.001 * most);
  EXPECT_GT(divergence.growth[40], 0.5 * most);
}

TEST(Transitions, TurnThePhasePlane) {
  const NoForce none;
  const Flow<double> flow(oscillator(0.0), none);
  std::vector<Point<double>> points;
  for (int k = 0; k <= 100; ++k) points.push_back({0.01 * k, {std::cos(0.01 * k), -std::sin(0.01 * k)}});
  Eigen::MatrixXd product = Eigen::Matrix2d::Identity();
  for (const Eigen::MatrixXd& transition : transition_matrices(flow, points)) product = transition * product;
  Eigen::Matrix2d turn;
  turn << std::cos(1.0), std::sin(1.0), -std::sin(1.0), std::cos(1.0);
  EXPECT_LT((product - turn).norm(), 1e-4);
}

/// The oscillator's study.
struct Oscillator {
  NoForce none;
  Flow<double> flow{oscillator(0.0), none};
  Flow<LongReal> long_flow{oscillator(LongReal()), none};
  ReferenceSolution reference =
      solve_reference(flow, &long_flow, ReferenceKind::kAutomatic, kSampling, 32, 4, 4, kSilent);
  std::vector<double> steps = {kSampling, kSampling / 2, kSampling / 4, kSampling / 8, kSampling / 16};

  WorkPrecision work() { return study_work_precision(flow, steps, kSampling, reference, true, {0}, kSilent); }
};

TEST(WorkPrecision, ErrorsAreTheTrueOnesAndOrdersTheMethodsOwn) {
  Oscillator study;
  const WorkPrecision work = study.work();
  ASSERT_EQ(work.points.size(), 10u);
  // One step of the method multiplies y + i y' by 1 − ih (Euler) or the first five terms of exp(−ih).
  for (const WorkPoint& point : work.points) {
    std::complex<long double> factor = 1, x = 1, power = 1;
    for (int k = 1; k <= (point.method == 0 ? 1 : 4); ++k) {
      power *= std::complex<long double>(0, -static_cast<long double>(point.h)) / static_cast<long double>(k);
      factor += power;
    }
    for (long i = 0; i < std::lround(2 / point.h); ++i) x *= factor;
    const long double error = std::fabs(x.real() - std::cos(2.0L));
    EXPECT_NEAR(point.end.position, double(error), 1e-14);
    ASSERT_TRUE(point.energy_drift);
    EXPECT_GT(*point.energy_drift, 0);
  }
  EXPECT_NEAR(*work.orders[0], 1, 0.01);
  EXPECT_NEAR(*work.orders[1], 4, 0.01);
}

TEST(WorkPrecision, GoesOnToShorterStepsWhereNoneKeepsTheToleranceAndErrorsFall) {
  Oscillator study;
  study.steps = {kSampling, kSampling / 2};
  WorkPrecision work = study.work();
  const auto more = [&](double tolerance, double seconds) {
    const double shortest = work.points.back().h;
    return go_on_to_shorter_steps(work, shortest, tolerance, study.flow, kSampling, study.reference, true,
                                  seconds, kSilent);
  };
  EXPECT_TRUE(more(1, 10).empty());
  EXPECT_TRUE(more(1e-9, 0).empty());
  EXPECT_FALSE(advise({1e-9, {}}, work, study.flow, kSampling, study.reference, {0}));
  const std::vector<double> steps = more(1e-9, 10);
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.front(), kSampling / 4);
  ASSERT_EQ(work.points.size(), 2 * (2 + steps.size()));
  for (std::size_t i = 1; i < work.points.size(); ++i) {
    const bool same_method = work.points[i].method == work.points[i - 1].method;
    EXPECT_EQ(same_method, work.points[i].h == work.points[i - 1].h / 2) << i;
  }
  const auto advice = advise({1e-9, {}}, work, study.flow, kSampling, study.reference, {0});
  ASSERT_TRUE(advice);
  EXPECT_LE(advice->error.position, 1e-9);
  // Rounding ends what steps can do.
  more(1e-30, 1000);
  EXPECT_GT(work.points.back().h, kSampling / 4096);
}

TEST(WorkPrecision, TheParetoFrontHasNoPointThatAnotherBeats) {
  std::vector<WorkPoint> points(4);
  const auto set = [](WorkPoint& point, double time, double error) {
    point.run_time = time;
    point.largest.position = error;
  };
  set(points[0], 1, 1e-3);
  set(points[1], 2, 1e-6);
  set(points[2], 3, 1e-5);
  set(points[3], 0.5, 1e-9);
  points[3].finite = false;
  mark_pareto_front(points);
  EXPECT_TRUE(points[0].pareto);
  EXPECT_TRUE(points[1].pareto);
  EXPECT_FALSE(points[2].pareto);
  EXPECT_FALSE(points[3].pareto);
}

TEST(ErrorSources, TogetherPredictTheMeasuredError) {
  Oscillator study;
  const auto transitions = transition_matrices(study.flow, study.reference.points);
  for (std::size_t method = 0; method < 2; ++method)
    for (std::size_t stride : {1u, 2u, 4u}) {
      const ErrorSources s =
          error_sources(study.flow, study.long_flow, method, study.reference, transitions, stride);
      EXPECT_LT(s.difference.position, 0.03 * s.measured.position);
      EXPECT_LT(s.rounding.position, 1e-14);
      // Each step of Euler's method misses h²/2 |x''|, of the fourth-order one h⁵/120: summed over |cos| on 2 s.
      const double local = method == 0 ? s.h / 2 : std::pow(s.h, 4) / 120;
      EXPECT_GT(s.truncation.position, local);
      EXPECT_LT(s.truncation.position, 2 * local);
    }
}

TEST(Advice, IsTheCheapestThatKeepsTheTolerance) {
  Oscillator study;
  const WorkPrecision work = study.work();
  const auto advice = advise({1e-6, {}}, work, study.flow, kSampling, study.reference, {0});
  ASSERT_TRUE(advice);
  EXPECT_EQ(advice->method, 1u);
  EXPECT_LE(advice->error.position, 1e-6);
  EXPECT_TRUE(advice->confirmed);
  for (const WorkPoint& point : work.points) {
    if (point.largest.position <= 1e-6) {
      EXPECT_GE(advice->h, point.h);
    }
  }
  EXPECT_FALSE(advise({1e-30, {}}, work, study.flow, kSampling, study.reference, {0}));
  EXPECT_FALSE(advise({{}, 1e-15}, work, study.flow, kSampling, study.reference, {0}));
}

TEST(Advice, IsNotGivenWithinWhatTheReferenceDoesNotKnow) {
  Oscillator study;
  const WorkPrecision work = study.work();
  ReferenceSolution rough = study.reference;
  rough.position_error = 9e-7;
  const auto advice = advise({1e-6, {}}, work, study.flow, kSampling, rough, {0});
  ASSERT_TRUE(advice);
  EXPECT_LE(advice->error.position + rough.position_error, 1e-6);
  rough.position_error = 1e-6;
  EXPECT_FALSE(advise({1e-6, {}}, work, study.flow, kSampling, rough, {0}));
}

TEST(Advice, StaysWithinThePredictedLimitOfTheMethod) {
  Oscillator study;
  const WorkPrecision work = study.work();
  MotionFacts facts;
  facts.limits.resize(2);
  MethodLimit& limit = facts.limits[1];
  const auto step = [&](double h, bool predicts) {
    limit.h = h;
    limit.predicts = predicts;
    const auto advice = advise({1e-3, {}}, work, study.flow, kSampling, study.reference, {0}, facts);
    return advice && advice->method == 1 ? advice->h : 0;
  };
  EXPECT_DOUBLE_EQ(step(kSampling / 2.9, true), kSampling / 3);
  EXPECT_GE(step(kSampling / 2.9, false), kSampling);
  EXPECT_GE(step(0, true), kSampling);  // undamped: the error shows what it grows by
  EXPECT_EQ(step(kSampling / 100, true), 0);
  Question budget;
  budget.budget = 1.0;
  budget.period = kSampling;
  limit.h = kSampling / 100;
  const auto advice = advise(budget, work, study.flow, kSampling, study.reference, {0}, facts);
  ASSERT_TRUE(advice);
  EXPECT_EQ(advice->method, 0u);
  EXPECT_FALSE(advice->runner_up);
}

TEST(Advice, IsNotGivenWhereAShorterStepMissesTheTolerance) {
  Oscillator study;
  WorkPrecision work = study.work();
  const auto step = [&](const MotionFacts& facts = {}) {
    const auto advice = advise({1e-3, {}}, work, study.flow, kSampling, study.reference, {0}, facts);
    return advice ? advice->h : 0;
  };
  EXPECT_GE(step(), kSampling);
  WorkPoint &second = work.points[6], &last = work.points[9];
  ASSERT_EQ(second.h, kSampling / 2);
  second.largest.position = 2e-3;
  EXPECT_GE(step(), kSampling / 4);
  EXPECT_LT(step(), kSampling / 2);
  last.largest.position = 2e-3;
  EXPECT_EQ(step(), 0);
  EXPECT_GE(step({{}, 1e12}), kSampling);  // rounding may be off by that
  second.largest.position = last.largest.position = 5e-4;
  study.reference.position_error = 9e-4;
  EXPECT_GE(step(), kSampling);  // the reference may be, too
}

TEST(Advice, IsTheMostAccurateWithinABudget) {
  Oscillator study;
  const WorkPrecision work = study.work();
  Question question;
  question.budget = 1.0;
  question.period = kSampling;
  const auto advice = advise(question, work, study.flow, kSampling, study.reference, {0});
  ASSERT_TRUE(advice);
  for (const WorkPoint& point : work.points) EXPECT_LE(advice->error.position, point.largest.position);
  ASSERT_TRUE(advice->runner_up);
  EXPECT_NE(advice->runner_up->method, advice->method);
}

/// Of the oscillator's table, without points.
Study without_advice(const Question& question) {
  Study study;
  study.options.question = question;
  study.judged = study.options.duration;
  study.divergence.growth = {1};
  study.reference.method = "CVODE";
  return study;
}

TEST(AdviceText, SaysWhyNothingIsRecommended) {
  Study study = without_advice({{}, 300e-9, 0.7e-3});
  study.work.points.resize(1);
  WorkPoint& point = study.work.points.front();
  const auto text = [&study] { return advice_text(oscillator(0.0), study); };
  point.h = 1e-3;
  point.run_time = 1;
  EXPECT_EQ(text(), "no method and step of this study keep within 300 ns per 700 us");
  point.run_time = 1e-6;
  EXPECT_EQ(text(),
            "within 300 ns per 700 us: no recommendation, no step of this study that costs no more divides "
            "700 us");
  point.h = 0.1e-3;
  EXPECT_EQ(text(), "within 300 ns per 700 us: no recommendation, what keeps within it is unstable");
  study.options.question = {1e-3, {}};
  EXPECT_THAT(text(), testing::EndsWith("is unstable, or a shorter step of the same method does not"));
  point.largest.position = 2e-3;
  EXPECT_THAT(text(), testing::HasSubstr("no method and step"));
  study.options.question = {{}, 300e-9, 0.7e-3};
  study.work.points.push_back(study.work.points.front());
  study.work.points.back().h = 1e-3;
  EXPECT_THAT(text(), testing::EndsWith("is unstable, or has a step that does not divide 700 us"));
}

TEST(AdviceText, SuggestsNoReferenceThatWasTaken) {
  Study study = without_advice({1e-6, {}});
  study.reference.position_error = 1;
  const auto suggestion = testing::HasSubstr("--reference extrapolation");
  EXPECT_THAT(advice_text(oscillator(0.0), study), suggestion);
  study.reference.digits = InFiftyDigits::kSolved;
  EXPECT_THAT(advice_text(oscillator(0.0), study), testing::Not(suggestion));
}

TEST(StiffText, NamesTheLimitOfTheRecommendedMethodToo) {
  Study study;
  study.stability.rate = 1;
  study.stability.limits.resize(2);
  for (const std::size_t m : {0u, 1u}) {
    MethodLimit& limit = study.stability.limits[m];
    limit.method = m;
    limit.h = m == 0 ? 2e-3 : 3.3e-3;
    limit.mode = -1000;
    limit.predicts = true;
  }
  study.advice.emplace().h = 2e-3;
  EXPECT_EQ(
      stiff_text(oscillator(0.0), study),
      "stiff: explicit methods need h < 3.3 ms (fourth), first h < 2 ms, whatever the accuracy asked for");
  study.advice->method = 1;
  EXPECT_EQ(stiff_text(oscillator(0.0), study),
            "stiff: explicit methods need h < 3.3 ms (fourth), whatever the accuracy asked for");
}

TEST(Remarks, SayWhatBecameOfFiftyDigits) {
  Study study = without_advice({});
  const auto expect = [&study](InFiftyDigits digits, const std::string& part) {
    study.reference.digits = digits;
    EXPECT_THAT(remarks(oscillator(0.0), study), testing::Contains(testing::HasSubstr(part)));
  };
  expect(InFiftyDigits::kNotTried, "no solution in 50 digits (--reference cvode)");
  expect(InFiftyDigits::kTooCostly, "no solution in 50 digits (too costly here)");
  expect(InFiftyDigits::kContradicted, "no solution in 50 digits (CVODE does not agree with it)");
}

TEST(Remarks, StateErrorsOfPositionsInTheirUnit) {
  Study study = without_advice({});
  study.reference.error = 5e-12;
  study.reference.position_error = 2e-6;
  EXPECT_THAT(remarks(oscillator(0.0), study),
              testing::Contains(testing::HasSubstr("position errors below 2e-05 (rad, m) say nothing")));
}

TEST(Remarks, SayThatTheTimeIsLongerThanAskedFor) {
  Study study = without_advice({});
  const auto longer = testing::Contains(testing::HasSubstr("the time is 2 s instead of 1 ms: whole"));
  EXPECT_THAT(remarks(oscillator(0.0), study), testing::Not(longer));
  study.longer = 2 - 1e-3;
  EXPECT_THAT(remarks(oscillator(0.0), study), longer);
}

TEST(ExpressionInputs, HaveKinksWhereAnExpressionOfTimeHas) {
  support::Diagnostics description(
      "cart_pole.toml", support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/cart_pole.toml"));
  const auto mechanism = model::read_mechanism(description);
  ASSERT_TRUE(mechanism);
  const auto has_kinks = [&mechanism](const std::string& push) {
    support::Diagnostics text("push.toml", "[input]\npush = \"" + push + "\"\n");
    const auto scenario = model::read_scenario(text, *mechanism);
    return scenario && ExpressionInputs(scenario->inputs, {}).has_kinks();
  };
  for (const char* push : {"if(t<0.5037, 1, -2)", "abs(t - 1)", "min(t, 1)", "floor(2*t)"})
    EXPECT_TRUE(has_kinks(push)) << push;
  for (const char* push : {"2*sin(5*t)", "max(1, 2)*t"}) EXPECT_FALSE(has_kinks(push)) << push;
}

}  // namespace
}  // namespace jourdain::tests
