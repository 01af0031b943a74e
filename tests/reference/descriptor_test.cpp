#include "reference/descriptor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/check.hpp"

namespace jourdain::reference {
namespace {

using model::Expression;
using model::JointType;
using Op = Expression::Op;
using Vector = Eigen::VectorXd;
using Vector3d = Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr double kRounding = 1e-12;  // solving a handful of rows in double

Vector vector(std::initializer_list<double> values) {
  return Eigen::Map<const Vector>(values.begin(), Eigen::Index(values.size()));
}

Expression product(const Expression& a, const Expression& b) {
  return Expression::binary(Op::kMultiply, a, b);
}
Expression variable(model::Variable::Kind kind, std::size_t index = 0, std::size_t component = 0) {
  return Expression::variable({kind, index, component});
}
Expression time() { return variable(model::Variable::Kind::kTime); }
Expression argument(std::size_t which) {
  return Expression::variable({model::Variable::Kind::kArgument, 0, which});
}

model::Body body(double mass, const model::Vector3& center, const std::array<double, 3>& moments) {
  model::Body result;
  result.mass = mass;
  result.center_of_mass = center;
  result.inertia.xx = moments[0];
  result.inertia.yy = moments[1];
  result.inertia.zz = moments[2];
  return result;
}

model::Joint joint(JointType type, const std::array<double, 3>& axis, std::size_t child) {
  model::Joint result;
  result.set_type(type);
  result.axis = axis;
  result.child = model::BodyIndex(child);
  return result;
}

/// A body on the world by one joint about or along z, gravity along −y.
model::Mechanism one_body(JointType type, const model::Body& only) {
  model::Mechanism mechanism;
  mechanism.gravity = {0.0, -kGravity, 0.0};
  mechanism.bodies = {only};
  mechanism.joints = {joint(type, {0, 0, 1}, 0)};
  return mechanism;
}

/// Point masses on massless rods along −y, turning about z.
model::Mechanism point_mass_chain(const std::vector<double>& masses, const std::vector<double>& lengths) {
  model::Mechanism mechanism;
  mechanism.gravity = {0.0, -kGravity, 0.0};
  for (std::size_t i = 0; i < masses.size(); ++i) {
    mechanism.bodies.push_back(body(masses[i], {0.0, -lengths[i], 0.0}, {}));
    mechanism.joints.push_back(joint(JointType::kRevolute, {0, 0, 1}, i));
    if (i == 0) continue;
    mechanism.joints[i].parent = model::BodyIndex(i - 1);
    mechanism.joints[i].placement.position = {0.0, -lengths[i - 1], 0.0};
  }
  return mechanism;
}

DescriptorSolution<double> solve(const model::Mechanism& mechanism, double t, std::initializer_list<double> y,
                                 std::initializer_list<double> z, std::initializer_list<double> u = {}) {
  return DescriptorReference<double>(mechanism).solve(t, vector(y), vector(z), vector(u));
}

void expect_near(const Vector3d& actual, const Vector3d& expected, double tolerance = kRounding) {
  EXPECT_LE((actual - expected).norm(), tolerance * (1 + expected.norm()))
      << actual.transpose() << " instead of " << expected.transpose();
}

TEST(DescriptorReference, FreeBodyObeysNewtonAndEuler) {
  const Vector3d center(0.1, -0.2, 0.3), moments(1, 2, 2.5), omega(0.4, -1.1, 0.7), force(3, -2, 5),
      moment(0.5, 0.6, -0.9);
  model::Mechanism mechanism = one_body(JointType::kFree, body(2, {0.1, -0.2, 0.3}, {1, 2, 2.5}));
  mechanism.frames.push_back({.name = "f", .body = model::BodyIndex(0), .placement = {{0.1, -0.2, 0.3}, {}}});
  mechanism.loads.push_back({.name = "l",
                             .frame = model::FrameIndex(0),
                             .force = {force.x(), force.y(), force.z()},
                             .moment = {moment.x(), moment.y(), moment.z()}});
  const double half = std::sqrt(0.5);  // a quarter turn about x
  const auto solution =
      solve(mechanism, 0, {1, 2, 3, half, half, 0, 0}, {0.3, 0.2, 0.1, omega.x(), omega.y(), omega.z()});
  const Vector3d gyroscopic = omega.cross(moments.cwiseProduct(omega));
  const Vector3d omega_dot = (moment - gyroscopic).cwiseQuotient(moments);
  const Vector3d a_C = Vector3d(force.x(), -force.z(), force.y()) / 2 + Vector3d(0, -kGravity, 0);
  expect_near(solution.bodies[0].omega_dot, omega_dot);
  expect_near(solution.bodies[0].a_C, a_C);
  const Vector3d relative = -(omega_dot.cross(center) + omega.cross(omega.cross(center)));
  const Vector3d a_O = a_C + Vector3d(relative.x(), -relative.z(), relative.y());
  expect_near(solution.bodies[0].a_O, a_O);
  expect_near(solution.zdot.head<3>(), a_O);
  expect_near(solution.zdot.tail<3>(), omega_dot);
  expect_near(solution.reactions[0].force, Vector3d::Zero());
  EXPECT_EQ(solution.size, 6);
}

TEST(DescriptorReference, GivesThePendulumsAccelerationAndReaction) {
  const double m = 2, l = 0.7, I = 0.3, angle = 0.4, rate = 1.3;
  const auto solution =
      solve(one_body(JointType::kRevolute, body(m, {0.0, -l, 0.0}, {I, I, I})), 0, {angle}, {rate});
  const double acceleration = -m * kGravity * l * std::sin(angle) / (I + m * l * l);
  EXPECT_NEAR(solution.zdot[0], acceleration, kRounding);
  const JointWrench<double>& reaction = solution.reactions[0];
  expect_near(reaction.force, {m * (l * acceleration + kGravity * std::sin(angle)),
                               m * (l * rate * rate + kGravity * std::cos(angle)), 0});
  expect_near(reaction.moment, Vector3d::Zero());
}

// Textbook equations in absolute angles a, b turn into relative ones by a = y1, b = y1 + y2.
TEST(DescriptorReference, GivesTheDoublePendulum) {
  const double m1 = 1.5, m2 = 0.8, l1 = 0.9, l2 = 1.2, y1 = 0.3, y2 = 0.6, z1 = 1.1, z2 = -2.3;
  const auto solution = solve(point_mass_chain({m1, m2}, {l1, l2}), 0, {y1, y2}, {z1, z2});
  const double c = m2 * l1 * l2 * std::cos(y2), s = m2 * l1 * l2 * std::sin(y2), lower = m2 * l2 * l2;
  Eigen::Matrix2d M;
  M << (m1 + m2) * l1 * l1 + lower + 2 * c, lower + c, lower + c, lower;
  const double weight2 = m2 * kGravity * l2 * std::sin(y1 + y2);
  const Eigen::Vector2d right(
      s * (2 * z1 * z2 + z2 * z2) - (m1 + m2) * kGravity * l1 * std::sin(y1) - weight2,
      -s * z1 * z1 - weight2);
  EXPECT_LE((M * Eigen::Vector2d(solution.zdot) - right).norm(), kRounding * right.norm());
}

// A pendulum on a cart that follows x = 0.5 sin(3 t): spring and damper of the cart's joint are not its drive's work.
TEST(DescriptorReference, GivesTheDriveOfAPrescribedCart) {
  const double mc = 3, m = 2, l = 0.7, angle = 0.4, rate = 1.3, t = 0.2, k = 50, d = 4;
  model::Mechanism mechanism = point_mass_chain({mc, m}, {0, l});
  mechanism.joints[0] = joint(JointType::kPrismatic, {1, 0, 0}, 0);
  model::Coordinate& cart = mechanism.joints[0].coordinates[0];
  cart.motion = product(0.5, Expression::unary(Op::kSin, product(3.0, time())));
  cart.stiffness = k;
  cart.damping = d;
  const auto solution = solve(mechanism, t, {angle}, {rate});
  const double x = 0.5 * std::sin(3 * t), v = 1.5 * std::cos(3 * t), a = -4.5 * std::sin(3 * t);
  const double angular = -(kGravity * std::sin(angle) + a * std::cos(angle)) / l;
  EXPECT_NEAR(solution.zdot[0], angular, kRounding * 10);
  const double inertia = (mc + m) * a + m * l * (angular * std::cos(angle) - rate * rate * std::sin(angle));
  EXPECT_NEAR(*solution.drives[0][0], inertia + k * x + d * v, kRounding * 100);
  EXPECT_FALSE(solution.drives[1][0].has_value());
  expect_near(solution.reactions[0].force,
              {inertia,
               (mc + m) * kGravity + m * l * (angular * std::sin(angle) + rate * rate * std::cos(angle)), 0});
}

TEST(DescriptorReference, AScrewTradesTurningForSinking) {
  const double m = 2, I = 0.3, pitch = 0.2, push = 1.5;
  model::Mechanism mechanism = one_body(JointType::kScrew, body(m, {}, {I, I, I}));
  mechanism.gravity = {0.0, 0.0, -kGravity};
  mechanism.joints[0].pitch = pitch;
  mechanism.actuators.resize(1);
  const auto solution = solve(mechanism, 0, {9.0}, {1.3}, {push});  // beyond a turn
  const double acceleration = (push - m * kGravity * pitch) / (I + m * pitch * pitch);
  EXPECT_NEAR(solution.zdot[0], acceleration, kRounding);
  expect_near(solution.bodies[0].a_O, {0, 0, pitch * acceleration});
  EXPECT_LE(solution.g.norm(), kRounding);
  EXPECT_NEAR(solution.reactions[0].force.z(), m * (kGravity + pitch * acceleration), kRounding * 10);
}

// On y = x²/2 with force Q on the coordinate x: (1 + x²) ẍ + x ẋ² = −g x + Q/m.
TEST(DescriptorReference, ABeadFollowsItsParabola) {
  const double m = 2, x = 0.8, v = 1.3, push = 3;
  model::Mechanism mechanism = one_body(JointType::kCurve, body(m, {}, {}));
  mechanism.joints[0].curve = {argument(0), product(0.5, Expression::power(argument(0), 2)), 0.0};
  mechanism.actuators.resize(1);
  const auto solution = solve(mechanism, 0, {x}, {v}, {push});
  const double acceleration = (push / m - kGravity * x - x * v * v) / (1 + x * x);
  EXPECT_NEAR(solution.zdot[0], acceleration, kRounding * 10);
  const double ay = x * acceleration + v * v;
  expect_near(solution.bodies[0].a_O, {acceleration, ay, 0});
  expect_near(solution.reactions[0].force, {m * acceleration, m * (ay + kGravity), 0});
}

TEST(DescriptorReference, RotorsAddInertiaButNoReaction) {
  const double I = 0.3, gear = 5, rotor = 0.02, input = 1.5;
  model::Mechanism mechanism = one_body(JointType::kRevolute, body(1, {}, {I, I, I}));
  mechanism.actuators.push_back(
      {.name = "motor", .joint = model::JointIndex(0), .gear_ratio = gear, .rotor_inertia = rotor});
  const auto solution = solve(mechanism, 0, {0.2}, {1.0}, {input});
  const double acceleration = gear * input / (I + gear * gear * rotor);
  EXPECT_NEAR(solution.zdot[0], acceleration, kRounding);
  EXPECT_NEAR(solution.reactions[0].moment.z(), gear * input, kRounding);
  EXPECT_NEAR(solution.rotor_wrenches[0].moment.z(), -gear * gear * rotor * acceleration, kRounding);
}

TEST(DescriptorReference, JointSpringsCountWholeTurns) {
  const double I = 0.3, k = 2, rest = 0.5, y = 20;
  model::Mechanism mechanism = one_body(JointType::kRevolute, body(1, {}, {I, I, I}));
  mechanism.joints[0].coordinates[0].stiffness = k;
  mechanism.joints[0].coordinates[0].rest = rest;
  EXPECT_NEAR(solve(mechanism, 0, {y}, {0.0}).zdot[0], -k * (y - rest) / I, kRounding * 1000);
}

/// Two point masses that slide along x, with frames on both.
model::Mechanism two_sliders(double m1, double m2) {
  model::Mechanism mechanism;
  for (std::size_t i = 0; i < 2; ++i) {
    mechanism.bodies.push_back(body(i == 0 ? m1 : m2, {}, {}));
    mechanism.joints.push_back(joint(JointType::kPrismatic, {1, 0, 0}, i));
    mechanism.frames.push_back({.name = "f", .body = model::BodyIndex(i), .placement = {}});
  }
  return mechanism;
}

TEST(DescriptorReference, SpringsPullTheirEndsTogether) {
  const double m1 = 2, m2 = 0.5, l0 = 0.4, k = 30, d = 3;
  model::Mechanism mechanism = two_sliders(m1, m2);
  mechanism.springs.push_back({.name = "s",
                               .from = model::FrameIndex(0),
                               .to = model::FrameIndex(1),
                               .stiffness = k,
                               .damping = d,
                               .free_length = l0,
                               .law = product(Expression::power(argument(0), 2), argument(1)),
                               .potential = {}});
  const auto solution = solve(mechanism, 0, {0.1, 1.0}, {-0.3, 0.5});
  const double length = 0.9, rate = 0.8;
  const double tension = k * (length - l0) + d * rate + length * length * rate;
  EXPECT_NEAR(solution.zdot[0], tension / m1, kRounding * 100);
  EXPECT_NEAR(solution.zdot[1], -tension / m2, kRounding * 100);
}

TEST(DescriptorReference, ExpressionsSeeTheWholeState) {
  using Kind = model::Variable::Kind;
  const double t = 0.3, y = 0.7, z = 1.2, u = 2.5;
  model::Mechanism mechanism = one_body(JointType::kRevolute, body(1, {}, {1, 1, 1}));
  mechanism.frames.push_back({.name = "f",
                              .body = model::BodyIndex(0),
                              .placement = {{2.0, 0.0, 0.0}, {.rpy = {std::numbers::pi / 2, 0.0, 0.0}}}});
  mechanism.inputs.push_back(model::Input());
  const auto acceleration = [&](const Expression& force) {
    mechanism.coordinate_forces = {{.name = "q", .joint = model::JointIndex(0), .force = force}};
    return solve(mechanism, t, {y}, {z}, {u}).zdot[0];
  };
  EXPECT_NEAR(acceleration(time()), t, kRounding);
  EXPECT_NEAR(acceleration(variable(Kind::kPosition)), y, kRounding);
  EXPECT_NEAR(acceleration(variable(Kind::kVelocity)), z, kRounding);
  EXPECT_NEAR(acceleration(variable(Kind::kInput)), u, kRounding);
  EXPECT_NEAR(acceleration(variable(Kind::kFramePosition, 0, 1)), 2 * std::sin(y), kRounding);
  EXPECT_NEAR(acceleration(variable(Kind::kFrameVelocity, 0, 0)), -2 * z * std::sin(y), kRounding);
  EXPECT_NEAR(acceleration(variable(Kind::kFrameSpin, 0, 1)), z, kRounding);
  EXPECT_NEAR(acceleration(variable(Kind::kFrameSpin, 0, 2)), 0, kRounding);
}

TEST(DescriptorReference, LoadsActInTheirAxes) {
  const double y = 0.7, force = 3;
  model::Mechanism mechanism = one_body(JointType::kRevolute, body(1, {}, {1, 1, 1}));
  mechanism.frames.push_back({.name = "f", .body = model::BodyIndex(0), .placement = {{2.0, 0.0, 0.0}, {}}});
  mechanism.loads.push_back(
      {.name = "l", .frame = model::FrameIndex(0), .force = {0.0, force, 0.0}, .moment = {}});
  EXPECT_NEAR(solve(mechanism, 0, {y}, {0.0}).zdot[0], 2 * force, kRounding);
  mechanism.loads[0].axes = model::LoadAxes::kWorld;
  EXPECT_NEAR(solve(mechanism, 0, {y}, {0.0}).zdot[0], 2 * force * std::cos(y), kRounding);
}

// The pendulum's axis is turned onto each inertial axis in turn. Leaving out a row of w_k × w_l for good would leave a
// zero row where the axis is a kept one.
TEST(DescriptorReference, CrossProductRowsFollowTheAxis) {
  model::Mechanism mechanism = point_mass_chain({1, 2}, {0.5, 0.7});
  mechanism.joints[0] = joint(JointType::kSpherical, {0, 0, 1}, 0);
  mechanism.bodies[0].inertia = {1.0, 1.5, 2.0, 0.0, 0.0, 0.0};
  const DescriptorReference<double> normals(mechanism);
  const DescriptorReference<double> products(mechanism, {.parallel_axes = ParallelAxes::kCrossProduct});
  const Vector z = vector({0.3, -0.4, 0.9, 1.1});
  Vector3d axes_seen = Vector3d::Zero();
  for (const double sign : {0.0, 0.5, -0.5}) {
    const Vector y = vector({sign == 0 ? 1 : 0.5, sign, sign, sign, 0.4});
    axes_seen += products.absolute_state(0, y, z)[0].orientation * Vector3d::UnitZ();
    const auto a = normals.solve(0, y, z, {}), b = products.solve(0, y, z, {});
    EXPECT_EQ(b.rank, b.size);
    EXPECT_LE((a.zdot - b.zdot).norm(), kRounding * a.zdot.norm());
  }
  expect_near(axes_seen, {1, 1, 1});
}

TEST(DescriptorReference, ReportsBodiesWhoseAccelerationIsUndetermined) {
  const auto moving_rank = [](const model::Mechanism& mechanism) {
    const auto solution = solve(mechanism, 0, {0.3, 0.4}, {0.0, 0.0});
    return solution.size - solution.rank;
  };
  EXPECT_EQ(moving_rank(point_mass_chain({0, 1}, {1, 1})), 0);  // a massless rod
  EXPECT_EQ(moving_rank(point_mass_chain({0, 1}, {0, 1})), 1);  // a massless ring on the axis
}

TEST(DescriptorReference, RefusesSizesThatDoNotFit) {
  const model::Mechanism mechanism = point_mass_chain({1, 1}, {1, 1});
  EXPECT_THROW(solve(mechanism, 0, {0.0}, {0.0}), support::InternalError);
  EXPECT_THROW(solve(mechanism, 0, {0.0, 0.0}, {0.0, 0.0}, {0.0}), support::InternalError);
  EXPECT_THROW(DescriptorReference<double>(mechanism, std::array{1.0}), support::InternalError);
}

}  // namespace
}  // namespace jourdain::reference
