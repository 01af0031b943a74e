// Stops and contacts against closed forms: what is stored comes back, what is lost is lost as the law says, and what
// rests on a slope creeps as smoothed friction lets it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "agreement/judge.hpp"
#include "compile/compile.hpp"
#include "model/read/read.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::tests {
namespace {

/// A particle that slides along three axes.
Derived particle(const std::string& elements, const std::string& gravity = "[0, 0, 0]") {
  const std::string text = fmt::format(R"([model]
name = "particle"
gravity = {}
[parameters]
mu = 0.5
[[body]]
name = "rail"
mass = 0
[[body]]
name = "bridge"
mass = 0
[[body]]
name = "ball"
mass = 2
[[joint]]
name = "x"
type = "prismatic"
axis = [1, 0, 0]
parent = "world"
child = "rail"
[[joint]]
name = "y"
type = "prismatic"
axis = [0, 1, 0]
parent = "rail"
child = "bridge"
[[joint]]
name = "z"
type = "prismatic"
axis = [0, 0, 1]
parent = "bridge"
child = "ball"
{})",
                                       gravity, elements);
  support::Diagnostics diagnostics("particle.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return derive(mechanism.value());
}

/// Classical Runge-Kutta steps of the program until `ends` holds; at most `most`.
Sample moved(const Derived& derived, Sample state, double h, const std::function<bool(const Sample&)>& ends,
             int most = 400000) {
  const std::size_t n = state.y.size();
  const auto rate = [&](const Sample& at) {
    return interpreted<double>(derived.module, "forward_dynamics", at);
  };
  const auto shifted = [&](const std::vector<double>& v, const std::vector<double>& a, double by) {
    Sample next = state;
    for (std::size_t i = 0; i < n; ++i) {
      next.y[i] += by * v[i];
      next.z[i] += by * a[i];
    }
    return next;
  };
  for (int k = 0; k < most && !ends(state); ++k) {
    const std::vector<double> v1 = state.z, a1 = rate(state);
    const Sample s2 = shifted(v1, a1, h / 2);
    const std::vector<double> v2 = s2.z, a2 = rate(s2);
    const Sample s3 = shifted(v2, a2, h / 2);
    const std::vector<double> v3 = s3.z, a3 = rate(s3);
    const Sample s4 = shifted(v3, a3, h);
    const std::vector<double> v4 = s4.z, a4 = rate(s4);
    for (std::size_t i = 0; i < n; ++i) {
      state.y[i] += h / 6 * (v1[i] + 2 * v2[i] + 2 * v3[i] + v4[i]);
      state.z[i] += h / 6 * (a1[i] + 2 * a2[i] + 2 * a3[i] + a4[i]);
    }
  }
  EXPECT_TRUE(ends(state));
  return state;
}

Sample at(std::vector<double> y, std::vector<double> z) {
  Sample sample;
  sample.parameters = {0.5};
  sample.y = std::move(y);
  sample.z = std::move(z);
  sample.zdot = {0, 0, 0};
  return sample;
}

/// Speed u after a contact that began with speed v, whatever k and e are: v/c − ln(1 + c v)/c² is what it was
/// (Hunt and Crossley).
double rebound(double v, double c) {
  const auto energy = [c](double speed) { return speed / c - std::log1p(c * speed) / (c * c); };
  double low = 0, high = std::min(v, 1 / c);
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (energy(-middle) < energy(v) ? low : high) = middle;
  }
  return (low + high) / 2;
}

TEST(Contact, LosesWhatHuntAndCrossleySay) {
  for (const double exponent : {1.0, 1.5, 2.0})
    for (const double damping : {0.1, 0.6}) {
      const Derived derived =
          particle(fmt::format("[[contact]]\nframe = \"ball\"\nnormal = [0, 0, 2]\npoint = [0, 0, "
                               "0.1]\nstiffness = 2e5\nexponent = {}\n"
                               "damping = {}\n",
                               exponent, damping));
      const double speed = 3;
      const Sample end = moved(derived, at({0, 0, 0.1 + 1e-9}, {0.7, 0, -speed}), 2e-6,
                               [](const Sample& s) { return s.z[2] > 0 && s.y[2] > 0.1; });
      EXPECT_NEAR(end.z[2], rebound(speed, damping), 1e-5) << exponent << " " << damping;
      EXPECT_EQ(end.z[0], 0.7);
    }
}

/// Behind the plane and before it, where its root has no value: F = k d^1.5 (1 + c d'), of a ball that sinks in by d.
TEST(Contact, IsDifferentiatedWhereItsPowerHasARoot) {
  const std::string text =
      "[model]\nname = \"ball\"\n[[body]]\nname = \"ball\"\nmass = 2\n[[joint]]\nname = \"z\"\ntype = "
      "\"prismatic\"\nparent = \"world\"\nchild = \"ball\"\n[[contact]]\nframe = \"ball\"\nradius = "
      "0.1\nstiffness = 1e4\nexponent = 1.5\ndamping = 0.3\n";
  support::Diagnostics diagnostics("ball.toml", text);
  CompileOptions options;
  options.functions = {"forward_dynamics_derivatives", "linearize", "residual_derivatives"};
  const CompiledModel compiled = compile(model::read_mechanism(diagnostics).value(), options);
  EXPECT_EQ(compiled.verdict.failures, std::vector<std::string>());
  for (const double depth : {-0.02, 0.004}) {
    Sample sample;
    sample.y = {0.1 - depth};
    sample.z = {-0.2};
    const std::vector<double> values =
        interpreted<double>(compiled.module, "forward_dynamics_derivatives", sample);
    const double d = std::max(depth, 0.0);
    EXPECT_NEAR(values.at(1), -1.5 * 1e4 * std::sqrt(d) * (1 + 0.3 * 0.2) / 2, 1e-9);
    EXPECT_NEAR(values.at(2), -1e4 * d * std::sqrt(d) * 0.3 / 2, 1e-9);
  }
}

TEST(Contact, CreepsOnASlopeAsSmoothedFrictionLetsIt) {
  // A slope of 20 degrees falls towards +x; the normal leans with it.
  const double slope = 20 * std::acos(-1) / 180, slip = 0.01;
  const Derived derived = particle(fmt::format("[[contact]]\nframe = \"ball\"\nnormal = [{}, 0, "
                                               "{}]\nstiffness = 1e4\ndamping = 10\nfriction = \"mu\"\n"
                                               "slip_speed = {}\n",
                                               std::sin(slope), std::cos(slope), slip),
                                   "[0, 0, -9.81]");
  int steps = 0;
  const Sample end =
      moved(derived, at({0, 0, 0}, {0, 0, 0}), 1e-4, [&](const Sample&) { return ++steps > 20000; });
  const double speed = std::hypot(end.z[0], end.z[2]), tangent = std::tan(slope);
  EXPECT_NEAR(speed, slip * tangent / std::sqrt(0.25 - tangent * tangent), 1e-8);
  EXPECT_GT(end.z[0], 0);
  const double depth = -(end.y[0] * std::sin(slope) + end.y[2] * std::cos(slope));
  EXPECT_NEAR(depth, 2 * 9.81 * std::cos(slope) / 1e4, 1e-9);
}

TEST(Contact, NeverPullsAndPushesOnlyBehindThePlane) {
  const Derived derived = particle(
      "[[contact]]\nframe = \"ball\"\nstiffness = 1e3\nexponent = 1.5\ndamping = 2\nfriction = "
      "0.3\nslip_speed = 0.1\n");
  const auto force = [&](double z, double rate) {
    const std::vector<double> zdot =
        interpreted<double>(derived.module, "forward_dynamics", at({0, 0, z}, {1, 2, rate}));
    return std::vector<double>{2 * zdot[0], 2 * zdot[1], 2 * zdot[2]};
  };
  EXPECT_EQ(force(0.01, -1), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(force(0, 0), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(force(-0.01, 0.6)[2], 0);  // it would pull: 1 + c d' < 0
  const double N = 1e3 * std::pow(0.04, 1.5) * (1 + 2 * 0.25), t = std::sqrt(5 + 0.01);
  const std::vector<double> pushed = force(-0.04, -0.25);
  EXPECT_NEAR(pushed[2], N, 1e-13 * N);
  EXPECT_NEAR(pushed[0], -0.3 * N / t, 1e-13 * N);
  EXPECT_NEAR(pushed[1], -0.3 * N * 2 / t, 1e-13 * N);
}

TEST(Stops, PushBackAtBothEnds) {
  const Derived derived =
      particle("[[stop]]\njoint = \"x\"\nlower = -0.2\nupper = 0.3\nstiffness = 100\ndamping = 5\n");
  const auto force = [&](double x, double rate) {
    return 2 * interpreted<double>(derived.module, "forward_dynamics", at({x, 0, 0}, {rate, 0, 0}))[0];
  };
  EXPECT_EQ(force(0.3, 1), 0);
  EXPECT_EQ(force(-0.2, -1), 0);
  EXPECT_NEAR(force(0.4, 0.5), -(100 * 0.1 + 5 * 0.5), 1e-13);
  EXPECT_EQ(force(0.4, -3), 0);
  EXPECT_NEAR(force(-0.5, -0.5), 100 * 0.3 + 5 * 0.5, 1e-13);
  EXPECT_EQ(force(-0.5, 9), 0);
}

TEST(Springs, PullOnlyOrPushOnly) {
  const std::string spring =
      "[[spring]]\nfrom = \"world\"\nto = \"ball\"\nstiffness = 100\nfree_length = 1\n";
  const auto force = [&](const Derived& derived, double x, double rate) {
    return 2 * interpreted<double>(derived.module, "forward_dynamics", at({x, 0, 0}, {rate, 0, 0}))[0];
  };
  const Derived rope = particle(spring + "damping = 3\nacts = \"pulling\"\n");
  EXPECT_EQ(force(rope, 0.8, 5), 0);
  EXPECT_NEAR(force(rope, 1.2, 0.5), -(100 * 0.2 + 3 * 0.5), 1e-12);
  EXPECT_EQ(force(rope, 1.2, -7), 0);
  const Derived gap = particle(spring + "damping = 3\nacts = \"pushing\"\n");
  EXPECT_EQ(force(gap, 1.2, -5), 0);
  EXPECT_NEAR(force(gap, 0.9, -0.5), 100 * 0.1 + 3 * 0.5, 1e-12);
  EXPECT_EQ(force(gap, 0.9, 4), 0);
  const Derived elastic = particle(spring + "acts = \"pulling\"\n");
  EXPECT_TRUE(elastic.mechanism.springs[0].conserves_energy());
  EXPECT_FALSE(rope.mechanism.springs[0].conserves_energy());
  const auto energy = [&](double length) {
    return elastic.mechanism.springs[0].potential.value().evaluate<double>(
        {}, [](double v) { return v; }, [&](const model::Variable&) { return length; });
  };
  EXPECT_EQ(energy(0.7), 0);
  EXPECT_NEAR(energy(1.3), 50 * 0.09, 1e-14);
  // It comes back from the rope with the speed that it had.
  const Sample end = moved(elastic, at({0.999999, 0, 0}, {2, 0, 0}), 1e-4,
                           [](const Sample& s) { return s.z[0] < 0 && s.y[0] < 0.99; });
  EXPECT_NEAR(end.z[0], -2, 1e-6);
}

/// The second reference, which takes bodies one by one, moves likewise.
TEST(Contact, MovesAsTheSecondReferenceSays) {
  const Derived derived = particle(
      "[[contact]]\nframe = \"ball\"\nnormal = [0.3, -0.2, 1]\nstiffness = 1e3\nexponent = 1.5\ndamping = "
      "0.3\n"
      "friction = 0.4\nslip_speed = 0.05\n[[stop]]\njoint = \"y\"\nlower = 0.1\nstiffness = 50\n",
      "[0, 0, -9.81]");
  const reference::DescriptorReference<long double> form(derived.mechanism, std::vector<long double>{0.5L});
  for (const double depth : {-0.1, -0.01, 0.02}) {
    const Sample sample = at({0.3, 0.05, depth}, {0.4, -0.2, -0.6});
    const std::vector<double> zdot = interpreted<double>(derived.module, "forward_dynamics", sample);
    reference::VectorX<long double> y(3), z(3);
    for (int i = 0; i < 3; ++i) {
      y[i] = sample.y[std::size_t(i)];
      z[i] = sample.z[std::size_t(i)];
    }
    const auto solution = form.solve(0, y, z, reference::VectorX<long double>(0));
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(zdot[std::size_t(i)], double(solution.zdot[i]),
                  1e-11 * (1 + std::fabs(zdot[std::size_t(i)])));
  }
}

}  // namespace
}  // namespace jourdain::tests
