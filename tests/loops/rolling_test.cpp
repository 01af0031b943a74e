// What rolls and glides without slip, against closed forms and published digits: a bicycle, a disc, a sleigh, a robot
// on two wheels, a snakeboard, a ball on a turntable, a rattleback.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "agreement/shared_data.hpp"
#include "compile/compile.hpp"
#include "loops/closed_programs.hpp"
#include "loops/plan/plan.hpp"
#include "properties/consistent_state.hpp"
#include "properties/random.hpp"
#include "reference/descriptor.hpp"
#include "studies/spectra.hpp"

namespace jourdain::tests {
namespace {

using Long = long double;
using VectorL = reference::VectorX<Long>;
using Matrix3L = reference::Matrix3<Long>;
using Vector3L = reference::Vector3<Long>;
using Complex = std::complex<double>;

// Accelerations in double, M of condition 1e3.
constexpr double kRounding = 1e-12;

model::Mechanism model_named(const std::string& name) { return read_model(model_path(name + ".toml")); }

/// The state that the mechanism starts with, z apart.
LoopState start_of(const ClosedPrograms& programs, const VectorL& z) {
  const std::vector<double>& y = programs.plan().y;
  return {0, Eigen::Map<const Eigen::VectorXd>(y.data(), Eigen::Index(y.size())).cast<Long>(), z};
}

/// Entries of z by name.
VectorL velocities(const ClosedPrograms& programs, const std::vector<std::pair<std::string, Long>>& given) {
  const std::vector<std::string>& names = programs.layout().velocity_names;
  VectorL z = VectorL::Zero(Eigen::Index(names.size()));
  for (const auto& [name, value] : given) {
    const auto found = std::find(names.begin(), names.end(), name);
    EXPECT_NE(found, names.end()) << name;
    z[found - names.begin()] = value;
  }
  return z;
}

Long acceleration(const ClosedPrograms& programs, const VectorL& zdot, const std::string& name) {
  const VectorL one = velocities(programs, {{name, 1}});
  return one.dot(zdot);
}

std::vector<Complex> eigenvalues(const Eigen::MatrixXd& A) {
  const Eigen::VectorXcd values = studies::spectrum(A).values;
  return {values.begin(), values.end()};
}

Complex nearest(const std::vector<Complex>& list, Complex to) {
  return *std::min_element(list.begin(), list.end(),
                           [to](Complex a, Complex b) { return std::abs(a - to) < std::abs(b - to); });
}

/// Of the linearised lean and steer, M x'' + v C1 x' + (g K0 + v^2 K2) x = 0: Meijaard et al. (2007), equation (6.3).
std::vector<Complex> published_modes(double v) {
  Eigen::Matrix2d M, C1, K0, K2;
  M << 80.81722, 2.31941332208709, 2.31941332208709, 0.29784188199686;
  C1 << 0, 33.86641391492494, -0.85035641456978, 1.68540397397560;
  K0 << -80.95, -2.59951685249872, -2.59951685249872, -0.80329488458618;
  K2 << 0, 76.59734589573222, 0, 2.65431523794604;
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A.topRightCorner<2, 2>().setIdentity();
  A.bottomLeftCorner<2, 2>() = -M.inverse() * (9.81 * K0 + v * v * K2);
  A.bottomRightCorner<2, 2>() = -M.inverse() * (v * C1);
  return eigenvalues(A);
}

/// Eigenvalues of the emitted `linearize` while the bicycle goes straight on with the speed v.
std::vector<Complex> bicycle_modes(const ClosedPrograms& programs, double v) {
  const VectorL z =
      velocities(programs, {{"root_vx", v}, {"rear", -Long(v) / 0.3L}, {"front", -Long(v) / 0.35L}});
  const auto values =
      programs.values("linearize", 0, programs.plan().y, std::vector<double>(z.begin(), z.end()), {0});
  const auto n = Eigen::Index(2 * z.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      if (const auto found = values.find(fmt::format("A[{}][{}]", i, j)); found != values.end())
        A(i, j) = found->second;
  return eigenvalues(A);
}

/// The others are 0, multiple ones that rounding moves: where it is, how it heads, its speed, and what the constraints
/// forbid. What they leave of the digits of the slow one at 6 m/s, -0.004/s, is little.
TEST(Rolling, BicycleHasThePublishedEigenvalues) {
  const ClosedPrograms programs(model_named("bicycle"), true);
  EXPECT_EQ(programs.operations("linearize"),
            9284u);  // twice as many by the operations that multipliers are computed in
  double worst = 0, slow = 0, others = 0;
  for (int v = 0; v <= 10; ++v) {
    std::vector<Complex> found = bicycle_modes(programs, v);
    for (const Complex expected : published_modes(v)) {
      const Complex mu = nearest(found, expected);
      const double error = std::abs(mu - expected);
      if (std::abs(expected) > 0.1)
        worst = std::max(worst, error / std::abs(expected));
      else
        slow = std::max(slow, error);
      found.erase(std::find(found.begin(), found.end(), mu));
    }
    for (const Complex mu : found) others = std::max(others, std::abs(mu));
  }
  fmt::print(
      "bicycle: eigenvalues within {:.1e} of those published, 0 to 10 m/s, the slow one {:.1e}/s; the others "
      "{:.1e}/s\n",
      worst, slow, others);
  EXPECT_LE(worst, 1e-11);
  EXPECT_LE(slow, 1e-7);
  EXPECT_LE(others, 1e-4);
  // As they stand in table 2 of the same: castering, capsize and weave at 5 m/s.
  const std::vector<Complex> at_5 = bicycle_modes(programs, 5);
  for (const Complex digits : {Complex(-14.078389692798216), Complex(-0.322866429004087),
                               Complex(-0.775341882195845, 4.464867713788229)})
    EXPECT_LE(std::abs(nearest(at_5, digits) - digits), 1e-9) << digits;
}

/// Euler's equations about the centre, the ground's force from its acceleration: with the axle at the angle a from the
/// vertical, turning at W about it and spinning at w about the axle,
///   (C + m r^2) w W sin a - A W^2 sin a cos a + m g r cos a = 0.
TEST(Rolling, DiscTurnsSteadilyAsItsEquationsSay) {
  const ClosedPrograms programs(model_named("rolling_disc"));
  const Long m = 2, r = 0.5L, g = 9.81L, A = m * r * r / 4, C = m * r * r / 2;
  for (const Long a : {0.6L, 1.2L, 1.9L})
    for (const Long W : {0.8L, -2.5L}) {
      const Long s = std::sin(a), c = std::cos(a);
      const Long w = (A * W * W * s * c - m * g * r * c) / ((C + m * r * r) * W * s);
      const Vector3L e1(-1, 0, 0), e2(0, -c, s), e3(0, s, c);
      Matrix3L R;
      R << e1, e3, -e2;
      const Eigen::Quaternion<Long> q(R);
      LoopState state = start_of(programs, VectorL::Zero(6));
      state.y << r * e2, q.w(), q.x(), q.y(), q.z();
      state.z << -r * w * e1, 0, w, -W * s;
      VectorL expected(6);
      expected << r * w * W * (s * e3 - c * e2), W * (s * w - c * W * s), 0, 0;
      const VectorL found = programs.accelerations(state, VectorL(0));
      EXPECT_LE(static_cast<double>((found - expected).norm() / expected.norm()), kRounding)
          << static_cast<double>(a) << " " << static_cast<double>(W);
    }
}

/// With v forward and w: v' = d w^2, w' = -m d v w/(I + m d^2).
TEST(Rolling, SleighFollowsItsTwoEquations) {
  const ClosedPrograms programs(model_named("sleigh"));
  const Long m = 5, d = 0.3L, I = 0.4L, v = 1.3L, w = -0.7L, angle = 0.6L;
  LoopState state = start_of(programs, VectorL(3));
  state.y << 0.4L, -2, angle;
  state.z << v * std::cos(angle), v * std::sin(angle), w;
  const Long forward = d * w * w, turning = -m * d * v * w / (I + m * d * d);
  VectorL expected(3);
  expected << forward * std::cos(angle) - v * w * std::sin(angle),
      forward * std::sin(angle) + v * w * std::cos(angle), turning;
  const VectorL found = programs.accelerations(state, VectorL(0));
  EXPECT_LE(static_cast<double>((found - expected).norm()), kRounding);
}

/// The robot on two wheels, its velocities independent ones or all with multipliers.
model::Mechanism robot(model::LoopTreatment treatment) {
  model::Mechanism mechanism = model_named("differential_drive");
  mechanism.loop_options = {};
  mechanism.loop_options.treatment = treatment;
  return mechanism;
}

TEST(Rolling, RobotOnTwoWheelsFollowsItsTwoEquations) {
  const ClosedPrograms programs(robot(model::LoopTreatment::kMultipliers));
  const Long r = 0.1L, b = 0.2L, d = 0.05L, base = 8, wheel = 0.5L, J = 0.0025L;
  const Long mass = base + 2 * wheel + 2 * J / (r * r),
             inertia = 0.2L + base * d * d + 2 * (wheel * b * b + 0.0013L) + 2 * J * b * b / (r * r);
  const Long v = 0.9L, w = 1.4L, angle = -0.8L, left = 0.3L, right = -0.2L;
  VectorL z = velocities(programs, {{"floor_x", v * std::cos(angle)},
                                    {"floor_y", v * std::sin(angle)},
                                    {"floor_angle", w},
                                    {"left", (v - b * w) / r},
                                    {"right", (v + b * w) / r}});
  LoopState state = start_of(programs, z);
  state.y = velocities(programs, {{"floor_angle", angle}, {"left", 3}});  // positions have the same names
  const Long forward = (base * d * w * w + (left + right) / r) / mass,
             turning = (-base * d * v * w + b * (right - left) / r) / inertia;
  const VectorL zdot = programs.accelerations(state, VectorL{{left, right}});
  const auto close = [&](const std::string& name, Long expected) {
    EXPECT_NEAR(double(acceleration(programs, zdot, name)), double(expected),
                1e-10 * (1 + std::fabs(double(expected))))
        << name;
  };
  close("floor_angle", turning);
  close("floor_x", forward * std::cos(angle) - v * w * std::sin(angle));
  close("left", (forward - b * turning) / r);
  close("right", (forward + b * turning) / r);
  const ClosedPrograms reduced(robot(model::LoopTreatment::kExplicit));
  ASSERT_EQ(reduced.plan().independent.size(), 2u);
  const VectorL found = reduced.accelerations(state, VectorL{{left, right}});
  for (Eigen::Index j = 0; j < 2; ++j)
    EXPECT_NEAR(double(found[j]), double(zdot[Eigen::Index(reduced.plan().independent[std::size_t(j)])]),
                1e-10);
}

constexpr const char* kSnakeboard = R"toml(
[model]
name = "snakeboard"
gravity = [0, 0, 0]
[[body]]
name = "board"
mass = 4
inertia = [1, 1, 0.3]
[[body]]
name = "rotor"
mass = 1
inertia = [1, 1, 0.08]
[[body]]
name = "front"
mass = 0.2
inertia = [1, 1, 0.01]
[[body]]
name = "back"
mass = 0.2
inertia = [1, 1, 0.01]
[[joint]]
name = "floor"
type = "planar"
parent = "world"
child = "board"
[[joint]]
name = "turn"
type = "revolute"
parent = "board"
child = "rotor"
[[joint]]
name = "steer"
type = "revolute"
parent = "board"
child = "front"
position = [0.25, 0, 0]
motion = "0.6*sin(2*t)"
[[joint]]
name = "follow"
type = "revolute"
parent = "board"
child = "back"
position = [-0.25, 0, 0]
motion = "-0.6*sin(2*t)"
[[input]]
name = "torque"
[[force]]
name = "motor"
joint = "turn"
value = "torque"
[[constraint]]
name = "front_wheels"
type = "knife_edge"
frame = "front"
axis = [0, 1, 0]
[[constraint]]
name = "back_wheels"
type = "knife_edge"
frame = "back"
axis = [0, 1, 0]
)toml";

/// A board on two axles that turn against each other by p and -p, with a rotor: its centre moves straight ahead with u,
/// and it turns with c u, c = tan(p)/l; projected onto that, with (J_r (c u)' + J_r w') = T of the rotor,
/// (m + c^2 J) u' = -c (J c' u + T), J without the rotor. After Ostrowski, Burdick, Lewis, Murray, The mechanics of
/// undulatory locomotion, ICRA 1995.
TEST(Rolling, SnakeboardFollowsItsEquationOfMomentum) {
  support::Diagnostics diagnostics("snakeboard.toml", kSnakeboard);
  const auto mechanism = model::read_mechanism(diagnostics, {});
  ASSERT_TRUE(mechanism) << diagnostics.format();
  const ClosedPrograms programs(*mechanism);
  const Long l = 0.25L, m = 5.4L, J = 0.3L + 2 * (0.01L + 0.2L * l * l), rotor = 0.08L;
  Random random(11);
  for (int i = 0; i < 6; ++i) {
    const Long t = random.uniform(0, 3), u = random.uniform(-2, 2), angle = random.uniform(-3, 3),
               torque = random.uniform(-1, 1);
    const Long p = 0.6L * std::sin(2 * t), p_rate = 1.2L * std::cos(2 * t);
    const Long c = std::tan(p) / l, c_rate = p_rate / (l * std::cos(p) * std::cos(p));
    const VectorL z = velocities(programs, {{"floor_x", u * std::cos(angle)},
                                            {"floor_y", u * std::sin(angle)},
                                            {"floor_angle", c * u},
                                            {"turn", random.uniform(-3, 3)}});
    LoopState state = start_of(programs, z);
    state.t = t;
    state.y = velocities(programs, {{"floor_x", 1}, {"floor_angle", angle}, {"turn", 2}});
    const Long ahead = -c * (J * c_rate * u + torque) / (m + c * c * J), turning = c * ahead + c_rate * u;
    const VectorL zdot = programs.accelerations(state, VectorL{{torque}});
    const auto close = [&](const std::string& name, Long expected) {
      EXPECT_NEAR(double(acceleration(programs, zdot, name)), double(expected),
                  1e-11 * (1 + std::fabs(double(expected))))
          << name << i;
    };
    close("floor_x", ahead * std::cos(angle) - u * c * u * std::sin(angle));
    close("floor_y", ahead * std::sin(angle) + u * c * u * std::cos(angle));
    close("floor_angle", turning);
    close("turn", torque / rotor - turning);
  }
}

constexpr const char* kGeared = R"toml(
[model]
name = "geared"
[[body]]
name = "crank"
mass = 1
inertia = [1, 1, 1]
[[body]]
name = "rod"
mass = 1
inertia = [1, 1, 1]
[[joint]]
name = "hinge"
type = "revolute"
parent = "world"
child = "crank"
[[joint]]
name = "elbow"
type = "revolute"
parent = "crank"
child = "rod"
position = [1, 0, 0]
[[constraint]]
name = "speeds"
velocity = "3*hinge.rate - 6*elbow.rate"
[[loop]]
name = "angles"
type = "residual"
residual = "hinge - 2*elbow - 0.3"
)toml";

/// A row of velocities that is the rate of one of positions is redundant, not the other way round: angles stay closed.
TEST(Rolling, RowsOfPositionsAreKeptWhereVelocitiesSayTheSame) {
  support::Diagnostics diagnostics("geared.toml", kGeared);
  const auto mechanism = model::read_mechanism(diagnostics, {});
  ASSERT_TRUE(mechanism) << diagnostics.format();
  const ClosedPrograms programs(*mechanism);
  EXPECT_EQ(programs.plan().redundant, std::vector<std::string>{"speeds.velocity"});
  EXPECT_EQ(programs.plan().freedom, 1u);
  const std::vector<double>& y = programs.plan().y;
  EXPECT_NEAR(y[0] - 2 * y[1], 0.3, 1e-15);
}

constexpr const char* kTurntable = R"toml(
[model]
name = "turntable"
[[body]]
name = "table"
mass = 1
inertia = [1, 1, 1]
[[body]]
name = "ball"
mass = 0.7
inertia = ["0.4*0.7*0.25^2", "0.4*0.7*0.25^2", "0.4*0.7*0.25^2"]
[[joint]]
name = "drive"
type = "revolute"
parent = "world"
child = "table"
position = [0.3, -0.1, 0.2]
motion = "1.7*t"
[[joint]]
name = "flight"
type = "free"
parent = "world"
child = "ball"
initial_position = [0.5, 0.4, 0.45]
[[constraint]]
name = "rolls"
type = "rolling_ball"
frame = "ball"
radius = 0.25
plane = "table"
)toml";

/// M depends on a state that a motion follows: the whole compiler agrees with itself, and with the descriptor form.
TEST(Rolling, ASteeringAngleThatStatesLeadIsInTheMassMatrix) {
  const model::Mechanism mechanism =
      read_model(std::string(JOURDAIN_SOURCE_DIR) + "/tests/loops/scenes/led_steering.toml");
  support::Diagnostics diagnostics("led_steering", "");
  CompileOptions options;
  options.loops = loops::plan_loops(mechanism, diagnostics);
  ASSERT_TRUE(options.loops) << diagnostics.format();
  const CompiledModel compiled = compile(mechanism, options);
  EXPECT_TRUE(compiled.verdict.accepted()) << compiled.verdict.failures.front();

  const ClosedPrograms programs(mechanism);
  const auto states = consistent_states(mechanism, 3, 4);
  ASSERT_TRUE(states);
  const reference::VectorX<long double> u = reference::VectorX<long double>::Constant(1, 0.4L);
  for (const LoopState& state : *states) {
    const auto expected =
        reference::DescriptorReference<long double>(mechanism).solve(state.t, state.y, state.z, u);
    EXPECT_LE(double((programs.accelerations(state, u) - expected.zdot).norm()),
              1e-13 * (1 + double(expected.zdot.norm())));
  }
}

/// A ball on a table that turns at W moves on circles with 2/7 of that: its centre's acceleration is 2/7 W k x v.
TEST(Rolling, BallOnATurntableGoesInCircles) {
  support::Diagnostics diagnostics("turntable.toml", kTurntable);
  const auto mechanism = model::read_mechanism(diagnostics, {});
  ASSERT_TRUE(mechanism) << diagnostics.format();
  const ClosedPrograms programs(*mechanism);
  const Long W = 1.7L, r = 0.25L;
  Random random(5);
  for (int i = 0; i < 5; ++i) {
    LoopState state = start_of(programs, VectorL::Zero(6));
    const Long t = state.t = random.uniform(0, 3);
    const Vector3L centre(random.uniform(-2, 2), random.uniform(-2, 2), 0.45L);
    const Vector3L table(-W * (centre.y() + 0.1L), W * (centre.x() - 0.3L), 0);
    const Vector3L v(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    const Long spin = random.uniform(-3, 3);
    // Of the point that touches v - r w x k, which the table moves: w = k x (v - table)/r about horizontal axes.
    const Vector3L k(0, 0, 1), w = k.cross(v - table) / r + spin * k;
    state.y.head(3) = centre;
    state.z.head(3) = v;
    state.z.tail(3) = w;  // the ball is not turned
    const VectorL zdot = programs.accelerations(state, VectorL(0));
    const Vector3L expected = Long(2) / 7 * W * k.cross(v);
    EXPECT_LE(static_cast<double>((zdot.head(3) - expected).norm()), kRounding) << static_cast<double>(t);
    EXPECT_NEAR(static_cast<double>(zdot[5]), 0, kRounding);
  }
}

constexpr const char* kRattleback = R"toml(
[model]
name = "rattleback"
[[body]]
name = "stone"
mass = 1.3
center_of_mass = [0, 0, -0.012]
inertia = { xx = 0.0016, yy = 0.0012, zz = 0.0022, xy = 0.0003 }
[[joint]]
name = "flight"
type = "free"
parent = "world"
child = "stone"
initial_position = [0, 0, 0.02]
[[constraint]]
name = "rolls"
type = "rolling_ellipsoid"
frame = "stone"
radii = [0.2, 0.03, 0.02]
)toml";

/// In the stone's axes, with the vertical g, the point p that touches from the centre of mass and the ground's force F:
///   v = -w x p, F = m (v' + w x v + 9.81 g), I w' + w x I w = p x F.
TEST(Rolling, RattlebackFollowsEulersEquations) {
  support::Diagnostics diagnostics("rattleback.toml", kRattleback);
  const auto mechanism = model::read_mechanism(diagnostics, {});
  ASSERT_TRUE(mechanism) << diagnostics.format();
  const ClosedPrograms programs(*mechanism);
  const Long m = 1.3L;
  const Vector3L centre(0, 0, -0.012L), D(0.04L, 0.0009L, 0.0004L);
  Matrix3L I;
  I << 0.0016L, 0.0003L, 0, 0.0003L, 0.0012L, 0, 0, 0, 0.0022L;
  Random random(11);
  for (int i = 0; i < 10; ++i) {
    const auto number = [&](double size) { return Long(random.uniform(-size, size)); };
    const Eigen::Quaternion<Long> q =
        Eigen::Quaternion<Long>(1, number(0.5), number(0.5), number(2)).normalized();
    const Matrix3L R = q.toRotationMatrix();
    const Vector3L g = R.transpose() * Vector3L::UnitZ(), w(number(3), number(3), number(6));
    const Vector3L g_rate = g.cross(w), Dg = D.cwiseProduct(g), Dg_rate = D.cwiseProduct(g_rate);
    const Long depth = std::sqrt(g.dot(Dg));
    const Vector3L touches = -Dg / depth, p = touches - centre,
                   p_rate = -Dg_rate / depth + Dg * g.dot(Dg_rate) / (depth * depth * depth);
    const Matrix3L about = I + m * (p.squaredNorm() * Matrix3L::Identity() - p * p.transpose());
    const Vector3L bias = m * p.cross(9.81L * g - w.cross(p_rate) - w.cross(w.cross(p))) - w.cross(I * w);
    const Vector3L expected = about.ldlt().solve(bias);
    LoopState state = start_of(programs, VectorL::Zero(6));
    state.y << number(1), number(1), depth, q.w(), q.x(), q.y(), q.z();
    state.z << -R * w.cross(touches), w;
    const VectorL zdot = programs.accelerations(state, VectorL(0));
    EXPECT_LE(static_cast<double>((zdot.tail(3) - expected).norm() / expected.norm()), kRounding) << i;
  }
}

}  // namespace
}  // namespace jourdain::tests
