// Cables and elastic teeth against what they are: forces by the gradient of a length, one tension all along, no push.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "agreement/judge.hpp"
#include "model/read/read.hpp"

namespace jourdain::tests {
namespace {

Derived cable_scene(const std::string& elements) {
  std::string text = "[model]\nname = \"scene\"\ngravity = [0, 0, 0]\n";
  for (const char* body : {"a", "b"})
    text += fmt::format(
        "[[body]]\nname = \"{0}\"\nmass = 2\n[[joint]]\nname = \"at_{0}\"\ntype = \"point\"\n"
        "parent = \"world\"\nchild = \"{0}\"\n",
        body);
  text +=
      "[[body]]\nname = \"w\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = \"wheel\"\ntype = "
      "\"revolute\"\n"
      "parent = \"world\"\nchild = \"w\"\n[[body]]\nname = \"p\"\nmass = 1\ninertia = [1, 1, 1]\n"
      "[[joint]]\nname = \"pinion\"\ntype = \"revolute\"\nparent = \"world\"\nchild = \"p\"\n" +
      elements;
  support::Diagnostics diagnostics("scene.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return derive(mechanism.value());
}

using Place = std::array<double, 3>;

double apart(const Place& a, const Place& b) { return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]); }

constexpr const char* kRope = R"([[frame]]
name = "ceiling"
body = "world"
position = [0.3, -0.2, 5]
[[frame]]
name = "sheave"
body = "world"
position = [2, 1, 4]
[[cable]]
through = ["ceiling", "a", "sheave", "b", "a"]
stiffness = 500
damping = 30
free_length = 14
)";

/// Of kRope at the places of a and b.
double rope_length(const std::vector<double>& y) {
  const Place a = {y[0], y[1], y[2]}, b = {y[3], y[4], y[5]}, ceiling = {0.3, -0.2, 5}, sheave = {2, 1, 4};
  return apart(ceiling, a) + apart(a, sheave) + apart(sheave, b) + apart(b, a);
}

TEST(Cable, PullsAlongTheGradientOfItsLengthWithOneTension) {
  const Derived derived = cable_scene(kRope);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-2, 2);
  int taut = 0, slack = 0;
  for (int k = 0; k < 40; ++k) {
    Sample sample;
    for (int i = 0; i < 8; ++i) {
      sample.y.push_back(number(random));
      sample.z.push_back(number(random));
      sample.zdot.push_back(0);
    }
    std::vector<double> gradient(8, 0);
    double rate = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      constexpr double kStep = 1e-5;
      std::vector<double> ahead = sample.y, behind = sample.y;
      ahead[i] += kStep;
      behind[i] -= kStep;
      gradient[i] = (rope_length(ahead) - rope_length(behind)) / (2 * kStep);
      rate += gradient[i] * sample.z[i];
    }
    const double stretch = rope_length(sample.y) - 14;
    const double tension = stretch > 0 ? std::max(500 * stretch + 30 * rate, 0.0) : 0;
    const std::vector<double> q = interpreted<double>(derived.module, "q_bar", sample);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(q[i], tension * gradient[i], 1e-6 * (1 + tension)) << k;
    ++(tension > 0 ? taut : slack);
  }
  EXPECT_GE(taut, 8);
  EXPECT_GE(slack, 8);
}

/// Of the torques on wheel (r = 0.2) and pinion (r = −0.05).
std::vector<double> mesh(const Derived& derived, double wheel, double pinion, double wheel_rate = 0) {
  Sample sample;
  sample.y = {0, 0, 0, 0, 0, 0, wheel, pinion};
  sample.z = {0, 0, 0, 0, 0, 0, wheel_rate, 0};
  sample.zdot = std::vector<double>(8, 0);
  const std::vector<double> q = interpreted<double>(derived.module, "q_bar", sample);
  return {-q[6], -q[7]};
}

constexpr const char* kTeeth = R"([[gear_mesh]]
first = "wheel"
second = "pinion"
first_radius = 0.2
second_radius = -0.05
stiffness = 1e5
damping = 1e3
)";

TEST(GearMesh, PushesByItsDeflectionAndMayHaveAGap) {
  const Derived tight = cable_scene(kTeeth), loose = cable_scene(std::string(kTeeth) + "backlash = 0.002\n");
  const auto expect = [](const std::vector<double>& torques, double force) {
    EXPECT_NEAR(torques[0], -0.2 * force, 1e-9);
    EXPECT_NEAR(torques[1], 0.05 * force, 1e-9);
  };
  expect(mesh(tight, 0.01, 0.02), 1e5 * 0.001);
  expect(mesh(tight, 0.01, 0.02, 0.1), 1e5 * 0.001 + 1e3 * 0.02);
  expect(mesh(tight, -0.01, 0.02), -1e5 * 0.003);
  expect(mesh(loose, 0.004, 0), 0);
  expect(mesh(loose, 0.004, 0, 3), 0);
  expect(mesh(loose, 0.01, 0), 1e5 * 0.001);
  expect(mesh(loose, -0.01, 0), -1e5 * 0.001);
  expect(mesh(loose, 0.01, 0, 0.1), 1e5 * 0.001 + 1e3 * 0.02);
  expect(mesh(loose, 0.01, 0, -3), 0);  // parting: no pull
}

}  // namespace
}  // namespace jourdain::tests
