// Stability functions against the emitted steps, predicted limits against runs that diverge.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/build_model.hpp"
#include "studies/judged.hpp"
#include "studies/report.hpp"
#include "studies/spectra.hpp"
#include "studies/stability.hpp"
#include "studies/study.hpp"

namespace jourdain::tests {
namespace {

using namespace studies;
using Complex = std::complex<double>;

/// y'' = −k y − d y' with k = 1.5, d = 0.8: µ = −0.4 ± 1.158 i.
struct Damped {
  EmittedModel model = emitted_from(oscillator_text(1.5, 0.8));
  ConstantInputs none{{}};
  Flow<double> flow{model.table(), none};
  Complex mu{-0.4, std::sqrt(1.5 - 0.16)};
  Eigen::Matrix2d A = (Eigen::Matrix2d() << 0, 1, -1.5, -0.8).finished();

  Eigen::Vector2d stepped(const jourdain_method& method, const Eigen::Vector2d& x, double h) const {
    Point<double> point{0, {x[0], x[1]}};
    Memory memory = flow.fresh_memory(method);
    flow.step(method, point, h, 1, memory);
    return {point.x[0], point.x[1]};
  }
};

TEST(StabilityFunctions, AreThoseOfTheEmittedSteps) {
  const Damped scene;
  for (const char* name : {"euler", "semi_implicit_euler", "heun", "rk4", "rk5"}) {
    const jourdain_method& method = scene.model.table().methods[method_called(scene.model.table(), name)];
    const StabilityFunction* function = stability_function(name);
    ASSERT_TRUE(function) << name;
    for (const double h : {0.05, 0.7, 2.0, 3.5}) {
      Eigen::Matrix2d step;
      step << scene.stepped(method, {1, 0}, h), scene.stepped(method, {0, 1}, h);
      EXPECT_LT((step - step_matrix(*function, scene.A, h)).norm(), 1e-12) << name << ", h = " << h;
      if (function->kind == StabilityFunction::Kind::kOneStep) {
        EXPECT_NEAR(amplification(*function, h * scene.mu), spectral_radius(Eigen::MatrixXd(step)), 1e-12)
            << name;
      }
    }
  }
}

TEST(StabilityFunctions, OfMultistepMethodsAreTheGrowthOfLongRuns) {
  const Damped scene;
  // The left eigenvector (−µ̄, 1) leaves one mode of the scene, which settles on the recursion's largest root.
  const Complex left = -std::conj(scene.mu);
  for (const char* name : {"adams_bashforth2", "adams_bashforth3"}) {
    const jourdain_method& method = scene.model.table().methods[method_called(scene.model.table(), name)];
    for (const double h : {0.05, 0.5, 1.1}) {
      Point<double> point = scene.flow.start();
      Memory memory = scene.flow.fresh_memory(method);
      const auto size = [&] { return std::abs(left * point.x[0] + point.x[1]); };
      scene.flow.step(method, point, h, 100, memory);
      const double before = size();
      scene.flow.step(method, point, h, 100, memory);
      EXPECT_NEAR(std::pow(size() / before, 0.01), amplification(*stability_function(name), h * scene.mu),
                  1e-3)
          << name << ", h = " << h;
    }
  }
}

TEST(StepLimit, IsTheKnownOneOnBothAxes) {
  const auto limit = [](const char* name, Complex mu) {
    return step_limit(*stability_function(name), mu, {});
  };
  EXPECT_NEAR(limit("euler", -1), 2, 1e-4);
  EXPECT_NEAR(limit("heun", -1), 2, 1e-4);
  EXPECT_NEAR(limit("rk4", -1), 2.7853, 1e-3);
  EXPECT_NEAR(limit("rk5", -1), 3.3066, 1e-3);
  EXPECT_NEAR(limit("adams_bashforth2", -1), 1, 1e-4);
  EXPECT_NEAR(limit("adams_bashforth3", -1), 6.0 / 11, 1e-4);
  EXPECT_NEAR(limit("rk4", Complex(0, 1)), 2 * std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(limit("adams_bashforth3", Complex(0, 1)), 0.7236, 1e-3);
  const Complex weak(-0.01, 2);
  EXPECT_NEAR(limit("euler", weak), 0.02 / std::norm(weak), 1e-7);
  EXPECT_EQ(limit("linearly_implicit_euler", -1), INFINITY);
  for (const char* name : {"euler", "heun", "adams_bashforth2"})
    EXPECT_FALSE(keeps_oscillations(*stability_function(name))) << name;
  for (const char* name : {"rk4", "rk5", "adams_bashforth3", "semi_implicit_euler"})
    EXPECT_TRUE(keeps_oscillations(*stability_function(name))) << name;
  EXPECT_FALSE(stability_function("a_method_of_tomorrow"));
}

TEST(RegionBoundary, LiesWhereNothingGrows) {
  for (const char* name : {"euler", "heun", "rk4", "rk5", "adams_bashforth2", "adams_bashforth3"}) {
    const StabilityFunction& function = *stability_function(name);
    const std::vector<Complex> boundary = region_boundary(function);
    ASSERT_FALSE(boundary.empty()) << name;
    for (const Complex x : boundary) EXPECT_NEAR(amplification(function, x), 1, 1e-3) << name;
  }
}

TEST(Linearisation, ByDifferencesIsThatOfTheEmittedDerivatives) {
  for (const char* name : {"crane", "flyball_governor"}) {
    const EmittedModel with = emitted_model(name),
                       without = emitted_model(name, commands::loadable_functions({"euler"}));
    ASSERT_TRUE(with.table().derivatives && !without.table().derivatives);
    const ConstantInputs none{{}};
    const Flow<double> flow(with.table(), none);
    Point<double> point = flow.start();
    for (std::size_t i = flow.position_count(); i < point.x.size(); ++i) point.x[i] = 0.3 + 0.1 * double(i);
    const model::Tangent tangent = model::lay_out_coordinates(with.mechanism).tangent;
    const Eigen::MatrixXd exact = linearisation(flow, point, tangent),
                          differences = linearisation(Flow<double>(without.table(), none), point, tangent);
    EXPECT_LE((differences - exact).norm(), 1e-8 * exact.norm())
        << name;  // of differences about 10 digits are left
  }
}

#ifndef JOURDAIN_SANITIZED  // runs by the million are too slow there

/// A hinge and an elbow on a stiff spring and damper, which does not start in its static deflection.
constexpr const char* kStiffElbow = R"(
[model]
name = "elbow"
gravity = [0, 0, -9.81]
[[body]]
name = "upper"
mass = 1
center_of_mass = [0.25, 0, 0]
inertia = [0.01, 0.02, 0.02]
[[body]]
name = "lower"
mass = 0.2
center_of_mass = [0.1, 0, 0]
inertia = [1e-4, 1e-4, 1e-4]
[[joint]]
name = "shoulder"
type = "revolute"
parent = "world"
child = "upper"
axis = [0, 1, 0]
initial_position = 0.2
[[joint]]
name = "elbow"
type = "revolute"
parent = "upper"
child = "lower"
position = [0.5, 0, 0]
axis = [0, 1, 0]
stiffness = 1e5
damping = 20
)";

TEST(Stability, StiffnessDoesNotDependOnTheStart) {
  const Judged elbow(emitted_from(kStiffElbow), 32, false);
  EXPECT_LT(elbow.stability.rate, 10);
  EXPECT_TRUE(elbow.stability.damps);
  EXPECT_TRUE(stiff_limit(elbow.stability));
  elbow.expect_observed("rk4");
}

TEST(Stability, ImplicitMethodsHaveLimitsThatRunsShow) {
  const Judged governor(emitted_model("flyball_governor"), 32, false);
  const MethodLimit& limit = governor.limit("rosw43");
  EXPECT_EQ(limit_text(limit), "none: L-stable");
  ASSERT_TRUE(limit.observed);
  EXPECT_GT(limit.observed->h, 0.1);
  EXPECT_LT(limit.observed->h, 0.2);
  const MethodLimit& none = governor.limit("linearly_implicit_euler");
  ASSERT_TRUE(none.stable_until);
  EXPECT_EQ(observed_text(none), "none up to 250 ms");
}

TEST(Stability, StiffGovernorHasTheLimitsThatItsRunsShow) {
  const Judged governor(emitted_model("flyball_governor"), 160, false);
  EXPECT_NEAR(governor.limit("rk4").h, 3.43e-4, 3e-6);
  EXPECT_NEAR(governor.limit("euler").h, 2 / 8118.0, 2e-6);
  for (const char* method :
       {"euler", "semi_implicit_euler", "heun", "rk4", "rk5", "adams_bashforth2", "adams_bashforth3"}) {
    governor.expect_observed(method);
    EXPECT_EQ(governor.limit(method).kind, ModeKind::kDamped) << method;
  }
  ASSERT_FALSE(governor.stability.owners.empty());
  EXPECT_EQ(governor.stability.owners.front().name, "slider");
  ASSERT_TRUE(stiff_limit(governor.stability));
  EXPECT_EQ(stiff_limit(governor.stability)->method, method_called(governor.model.table(), "rk5"));
}

TEST(Stability, OscillatorWithoutDampingLeavesNoStableStepToSomeMethods) {
  const Judged oscillator(emitted_from(oscillator_text(100, 0)), 32, true);
  EXPECT_FALSE(oscillator.stability.damps);
  for (const char* method : {"euler", "heun", "adams_bashforth2"}) {
    EXPECT_EQ(oscillator.limit(method).h, 0) << method;
    EXPECT_EQ(limit_text(oscillator.limit(method)), "none: undamped mode");
  }
  EXPECT_NEAR(oscillator.limit("rk4").h, 0.28284, 1e-4);
  EXPECT_NEAR(oscillator.limit("semi_implicit_euler").h, 0.2, 2e-3);
  for (const char* method : {"semi_implicit_euler", "rk4", "adams_bashforth3"})
    oscillator.expect_observed(method);
  EXPECT_FALSE(stiff_limit(oscillator.stability));
}

TEST(Stability, WeakDampingDecidesOnEuler) {
  const Judged oscillator(emitted_from(oscillator_text(100, 0.4)), 32, false);
  EXPECT_TRUE(oscillator.stability.damps);
  EXPECT_NEAR(oscillator.limit("euler").h, 0.4 / 100, 1e-5);
  for (const char* method : {"euler", "semi_implicit_euler", "heun", "rk4", "rk5", "adams_bashforth3"})
    oscillator.expect_observed(method);
  EXPECT_FALSE(stiff_limit(oscillator.stability));
}

TEST(Stability, ForcedCartDivergesWhereItsSpringAndDamperSayAndNotWhereItResonates) {
  const Judged cart(emitted_model("shaking_cart"), 32, false);
  EXPECT_NEAR(cart.limit("euler").h, 15.0 / 900, 1e-5);  // 2 |Re µ| / |µ|² = damping / stiffness
  for (const char* method :
       {"euler", "semi_implicit_euler", "heun", "rk4", "rk5", "adams_bashforth2", "adams_bashforth3"})
    cart.expect_observed(method);
}

TEST(Stability, PredictsNothingWhereModesChangeAsFastAsTheMotion) {
  const Judged four_bar(emitted_model("four_bar"), 32, false);
  for (const char* method : {"semi_implicit_euler", "heun", "rk4", "rk5", "adams_bashforth3"}) {
    const MethodLimit& limit = four_bar.limit(method);
    EXPECT_FALSE(limit.predicts) << method;
    EXPECT_EQ(limit_text(limit), "-") << method;
    ASSERT_TRUE(limit.observed) << method;
    EXPECT_EQ(limit.observed->start, 0) << method;
    EXPECT_EQ(largest_stable_step(limit), limit.observed->h) << method;
    for (const StabilityPoint& point : four_bar.stability.points)
      EXPECT_EQ(point.limits[limit.method], INFINITY) << method;
  }
  EXPECT_LT(four_bar.limit("heun").observed->h, four_bar.limit("rk4").observed->h);
}

TEST(Stability, ObservesFalseOscillationsAsDivergence) {
  // A strut whose runs settle on a cycle of two steps, with and without displacement.
  const Judged strut(emitted_model("mcpherson_strut"), 32, false);
  strut.expect_observed("semi_implicit_euler");
}

TEST(Stability, TopOnABallJointHasNoModeOfItsQuaternion) {
  const Judged top(emitted_model("lagrange_top"), 32, true);
  for (const StabilityPoint& point : top.stability.points) EXPECT_EQ(point.eigenvalues.size(), 6u);
  // The spin of 60 rad/s is no mode. Precession in the body is: (1 − I3/I1) 60 rad/s, a little slower under gravity.
  EXPECT_NEAR(std::abs(top.stability.fastest.imag()), 39.8, 0.1);
  top.expect_observed("rk4");
  top.expect_observed("adams_bashforth3");
  const Eigen::MatrixXd A = linearisation(top.flow, top.reference.points[3], top.tangent);
  ASSERT_EQ(A.rows(), 6);
  // Turning the whole scene about the vertical changes nothing.
  const Eigen::Vector4d q(top.reference.points[3].x.data());
  const Eigen::Vector3d vertical =
      Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix().transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_LT((A.bottomLeftCorner(3, 3) * vertical).norm(), 1e-8);
}

TEST(Stability, ReportSaysThatTheGovernorIsStiff) {
  const EmittedModel governor = emitted_model("flyball_governor");
  const ConstantInputs none({});
  const Flow<double> flow(governor.table(), none);
  std::vector<double> parameters;
  for (const model::Parameter& parameter : governor.mechanism.parameters)
    parameters.push_back(parameter.value);
  StudyOptions options;
  options.duration = 0.5;
  options.longest_step = 2e-3;
  options.halvings = 4;
  options.reference = ReferenceKind::kCvode;
  options.question.tolerance = 1e-5;
  options.forms = false;
  const Study study =
      run_study(governor.mechanism, governor.tangent, parameters, flow, nullptr, nullptr, options, kSilent);
  const auto says = testing::HasSubstr("stiff: explicit methods need h < ");
  EXPECT_THAT(advice_text(governor.table(), study), says);
  const ReportHead head{"flyball_governor", "", "", "", "double", "", "", ""};
  EXPECT_THAT(report_text(head, governor.table(), study), testing::HasSubstr("largest stable step"));
  const auto report = nlohmann::json::parse(report_json(head, governor.table(), study));
  EXPECT_EQ(report["stability"]["limits"].size(), std::size_t(governor.table().method_count));
  EXPECT_EQ(report["stability"]["fastest_mode_belongs_to"][0]["coordinate"], "slider");
  const auto files = report_csv(head, governor.table(), study);
  EXPECT_TRUE(
      std::any_of(files.begin(), files.end(), [](const auto& f) { return f.name == "stability.csv"; }));
}

/// A damper at rest that is far faster than the oscillation.
constexpr const char* kRestingDamper = R"(
[model]
name = "resting_damper"
gravity = [0, 0, 0]
[[body]]
name = "a"
mass = 1
[[body]]
name = "b"
mass = 1
[[joint]]
name = "x"
type = "prismatic"
parent = "world"
child = "a"
axis = [1, 0, 0]
stiffness = 4
initial_position = 0.1
[[joint]]
name = "y"
type = "prismatic"
parent = "a"
child = "b"
axis = [0, 1, 0]
stiffness = 100
damping = 1000
)";

/// No inputs, which have kinks.
class KinkedInputs : public ConstantInputs {
 public:
  KinkedInputs() : ConstantInputs({}) {}
  bool has_kinks() const override { return true; }
};

TEST(Study, RecommendsStableStepsAndKnowsTheKinksOfInputs) {
  const EmittedModel model = emitted_from(kRestingDamper, commands::loadable_functions({"euler", "rk5"}));
  const KinkedInputs none;
  const Flow<double> flow(model.table(), none);
  StudyOptions options;
  options.duration = 1;
  options.halvings = 4;
  options.reference = ReferenceKind::kCvode;
  options.question.tolerance = 1e-5;
  options.forms = false;
  const Study study = run_study(model.mechanism, model.tangent, {}, flow, nullptr, nullptr, options, kSilent);
  EXPECT_TRUE(study.has_kinks);
  EXPECT_NEAR(study.longer, 0.008, 1e-12);  // 63 steps of 16 ms
  ASSERT_TRUE(study.advice);
  const MethodLimit& limit = study.stability.limits[study.advice->method];
  ASSERT_TRUE(limit.predicts);
  EXPECT_LE(study.advice->h, limit.h);
  EXPECT_TRUE(study.advice->confirmed);
  EXPECT_THAT(advice_text(model.table(), study), testing::HasSubstr("stiff: explicit methods need h < "));
}

#endif

}  // namespace
}  // namespace jourdain::tests
