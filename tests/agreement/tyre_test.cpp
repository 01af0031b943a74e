// Tyres against their formulas, written a second time on vectors: load, slip, Magic Formula, brush, relaxation.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "agreement/judge.hpp"
#include "model/read/read.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {
namespace {

using Vector3 = Eigen::Vector3d;

const std::string kWheel = R"([model]
name = "wheel"
gravity = [0, 0, 0]
[[body]]
name = "wheel"
mass = 20
inertia = [0.6, 1, 0.6]
[[joint]]
name = "flight"
type = "free"
parent = "world"
child = "wheel"
[[frame]]
name = "hub"
body = "wheel"
rpy = [0, 0, "90 deg"]
[[tyre]]
name = "tyre"
frame = "hub"
axis = [1, 0, 0]
point = [0, 0, -0.1]
normal = [0.6, 0, 0.8]
radius = 0.31
stiffness = 2e5
damping = 500
friction = 0.9
relaxation_length = 0.3
)";

const std::string kMagic =
    "stiffness_factor = [12, 10]\nshape_factor = [1.6, 1.3]\ncurvature_factor = [0.2, -0.5]\n";
const std::string kBrush = "law = \"brush\"\nslip_stiffness = 14\n";

Derived scene(const std::string& text) {
  support::Diagnostics diagnostics("wheel.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return derive(mechanism.value());
}

/// Force over load at a slip forward (0) or sideways (1).
double magic(std::size_t i, double slip) {
  const double B[] = {12, 10}, C[] = {1.6, 1.3}, E[] = {0.2, -0.5};
  const double x = B[i] * slip;
  return 0.9 * std::sin(C[i] * std::atan(x - E[i] * (x - std::atan(x))));
}

double brush(double slip) {
  const double x = 14 * slip / (3 * 0.9);
  return x < 1 ? 0.9 * (3 * x - 3 * x * x + x * x * x) : 0.9;
}

struct State {
  Vector3 centre, v;
  Eigen::Quaterniond q;
  Vector3 w;         ///< body axes
  double s[2] = {};  ///< deflections
};

struct Expected {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();  ///< inertial axes, about the centre
  double rate[2] = {};
  double load = 0;
};

template <class Law>
Expected expected(const State& state, const Law& law) {
  const Vector3 n(0.6, 0, 0.8), o(0, 0, -0.1), axle = state.q * Vector3(0, 1, 0), w = state.q * state.w;
  const Vector3 forward = axle.cross(n).normalized(), left = n.cross(forward);
  const Vector3 down = axle.cross(forward);
  const double upright = axle.cross(n).norm(), height = n.dot(state.centre - o),
               depth = 0.31 * upright - height;
  Expected result;
  if (depth > 0) result.load = std::max(0.0, 2e5 * depth - 500 * n.dot(state.v));
  const Vector3 slipping = state.v + w.cross(0.31 * down);
  const double rolling = std::max(std::fabs(forward.dot(state.v)), 0.31 * std::fabs(w.dot(axle)));
  const double slip[] = {state.s[0] / 0.3, state.s[1] / 0.3}, total = std::hypot(slip[0], slip[1]);
  result.force = result.load * n;
  const Vector3 along[] = {forward, left};
  for (std::size_t i = 0; i < 2; ++i) {
    result.rate[i] = -rolling * slip[i] - (depth > 0 ? along[i].dot(slipping) : 0);
    result.force += result.load * law(i, total) * slip[i] / total * along[i];
  }
  result.moment = (down * (height / upright)).cross(result.force);
  return result;
}

/// Near the plane, with slips through the whole curve; the largest difference, of forces over the load.
template <class Law>
double worst(const std::string& text, const Law& law, int& touching, int& apart) {
  const Derived derived = scene(text);
  Random random(17);
  double worst = 0;
  for (int k = 0; k < 60; ++k) {
    const auto number = [&](double size) { return random.uniform(-size, size); };
    State state;
    state.centre = Vector3(0, number(1), -0.1) + (0.3 + number(0.05)) * Vector3(0.6, 0, 0.8) +
                   number(1) * Vector3(0.8, 0, -0.6);
    state.v = {number(3), number(3), number(0.5)};
    state.q = Eigen::Quaterniond(1, number(0.2), number(0.3), number(1)).normalized();
    state.w = {number(1), number(20), number(2)};
    for (double& s : state.s) s = number(0.1);
    const Expected hand = expected(state, law);
    Sample sample;
    sample.y = {state.centre.x(), state.centre.y(), state.centre.z(), state.q.w(),
                state.q.x(),      state.q.y(),      state.q.z()};
    sample.z = {state.v.x(), state.v.y(), state.v.z(), state.w.x(),
                state.w.y(), state.w.z(), state.s[0],  state.s[1]};
    sample.zdot = std::vector<double>(8, 0);
    const std::vector<double> q = interpreted<double>(derived.module, "q_bar", sample);
    const Vector3 moment = state.q.conjugate() * hand.moment;
    for (int i = 0; i < 3; ++i) {
      worst = std::max(worst, std::fabs(q[std::size_t(i)] + hand.force[i]) / (1 + hand.load));
      worst = std::max(worst, std::fabs(q[std::size_t(3 + i)] + moment[i]) / (1 + hand.load));
    }
    for (std::size_t i = 0; i < 2; ++i) worst = std::max(worst, std::fabs(q[6 + i] + hand.rate[i]) / 10);
    ++(hand.load > 0 ? touching : apart);
  }
  return worst;
}

TEST(Tyre, IsItsFormulasOnASlope) {
  int touching = 0, apart = 0;
  EXPECT_LE(worst(kWheel + kMagic, magic, touching, apart), 1e-11);
  EXPECT_LE(worst(
                kWheel + kBrush, [](std::size_t, double slip) { return brush(slip); }, touching, apart),
            1e-11);
  EXPECT_GE(touching, 30);
  EXPECT_GE(apart, 20);
}

/// A slip that lasts: forces by the Magic Formula's table of slips.
TEST(Tyre, SettlesAtTheSlipThatIsAskedFor) {
  const double speed = 20, asked = 0.08, s = 0.3 * asked;
  const Derived derived = scene(kWheel + kMagic);
  Sample sample;
  const Vector3 n(0.6, 0, 0.8), forward = Vector3(0, 1, 0).cross(n), centre = Vector3(0, 0, -0.1) + 0.3 * n;
  const Vector3 v = speed * forward;
  sample.y = {centre.x(), centre.y(), centre.z(), 1, 0, 0, 0};
  sample.z = {v.x(), v.y(), v.z(), 0, speed * (1 - asked) / 0.31, 0, -s, 0};
  sample.zdot = std::vector<double>(8, 0);
  const std::vector<double> q = interpreted<double>(derived.module, "q_bar", sample);
  EXPECT_NEAR(q[6], 0, 1e-7);  // braking at a slip of 8 %: nothing changes
  const Vector3 force(-q[0], -q[1], -q[2]);
  EXPECT_NEAR(force.dot(forward), -2000 * magic(0, asked), 1e-4);
  EXPECT_NEAR(force.dot(n), 2000, 1e-9);
}

/// On its side, beside the ground and on it: there is no direction forward, and nothing but the load.
TEST(Tyre, LyingFlatHasForces) {
  const Derived derived = scene(kWheel + kMagic);
  const double half = std::acos(0.8) / 2;  // turns z to the plane's normal; then the axle follows
  const Eigen::Quaterniond q = Eigen::Quaterniond(std::cos(half), 0, std::sin(half), 0) *
                               Eigen::Quaterniond(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
  const Vector3 n(0.6, 0, 0.8);
  EXPECT_NEAR((q * Vector3(0, 1, 0)).cross(n).norm(), 0, 1e-15);
  for (const double height : {0.02, -0.001}) {
    const Vector3 centre = Vector3(0, 0, -0.1) + height * n;
    Sample sample;
    sample.y = {centre.x(), centre.y(), centre.z(), q.w(), q.x(), q.y(), q.z()};
    sample.z = {-0.8, 2, 0.6, 0, 3, 0, 0.01, 0.02};
    sample.zdot = std::vector<double>(8, 0);
    const std::vector<double> f = interpreted<double>(derived.module, "q_bar", sample);
    const Vector3 force(-f[0], -f[1], -f[2]);
    for (const double entry : f) EXPECT_TRUE(std::isfinite(entry)) << height;
    EXPECT_LE((force - (height < 0 ? force.dot(n) : 0) * n).norm(), 1e-4) << height;
    EXPECT_EQ(force.dot(n) > 1, height < 0);
  }
}

}  // namespace
}  // namespace jourdain::tests
