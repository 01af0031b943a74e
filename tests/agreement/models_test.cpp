// The models of the project against the descriptions and equations that they were written from.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "properties/random.hpp"
#include "shared_data.hpp"

namespace jourdain::tests {
namespace {

using std::numbers::pi;
using Terms = reference::Terms<double>;
using Vector = reference::VectorX<double>;

constexpr int kStates = 20;
// The same numbers in other frames and another order of summation.
constexpr double kSameNumbers = 1e-13;

/// Largest normwise difference of M, k̄ and q̄ between two mechanisms with the same coordinates, over random
/// states.
double worst_difference(const model::Mechanism& one, const model::Mechanism& other) {
  const reference::Reference<double> a(one), b(other);
  Random random(7);
  double worst = 0;
  for (int i = 0; i < kStates; ++i) {
    const auto count = Eigen::Index(a.coordinate_count());
    reference::State<double> state{.t = 0, .y = Vector(count), .z = Vector(count)};
    for (double& angle : state.y) angle = random.uniform(-pi, pi);
    for (double& rate : state.z) rate = random.uniform(-2, 2);
    Vector u(count);
    for (double& torque : u) torque = random.uniform(-10, 10);
    const Terms s = a.evaluate(state, u), t = b.evaluate(state, u);
    for (const double error :
         {normwise_error(s.M, t.M), normwise_error(s.k_bar, t.k_bar), normwise_error(s.q_bar, t.q_bar)})
      worst = larger_error(worst, error);
  }
  return worst;
}

model::Mechanism undamped_robot(const std::string& robot, const std::vector<std::string>& locked) {
  model::ReadOptions options;
  options.damping = false;
  options.locked_joints = locked;
  return read_model(urdf_path(robot), options);
}

Terms initial_terms(const std::string& name) {
  const reference::Reference<double> reference(read_model(model_path(name)));
  return reference.evaluate(reference.initial_state(), Vector::Zero(Eigen::Index(reference.input_count())));
}

TEST(Models, PandaIsItsUrdfWithLockedFingers) {
  if (!has_robot("panda")) return;
  const model::Mechanism urdf = undamped_robot("panda", {"panda_finger_joint1", "panda_finger_joint2"});
  EXPECT_LE(worst_difference(read_model(model_path("panda.toml")), urdf), kSameNumbers);
}

TEST(Models, Ur5IsItsUrdf) {
  if (!has_robot("ur5")) return;
  EXPECT_LE(worst_difference(read_model(model_path("ur5.toml")), undamped_robot("ur5", {})), kSameNumbers);
}

TEST(Models, PendulumStartsHorizontallyAtTheLeft) {
  const reference::Reference<double> reference(read_model(model_path("pendulum.toml")));
  const reference::Vector3<double> bob = reference.motion(reference.initial_state())[0].p_WC;
  EXPECT_NEAR((bob - reference::Vector3<double>(-1, 0, 0)).norm(), 0, 1e-15);
  const Terms terms = initial_terms("pendulum.toml");
  EXPECT_NEAR(terms.M(0, 0), 1, 1e-15);
  EXPECT_NEAR(reference::forward_dynamics(terms)[0], 9.81, 1e-14);
}

// Absolute angles a = 45° and b = 90°:  2 a'' + cos(b − a) b'' = −2 g sin a,  cos(b − a) a'' + b'' = −g sin
// b.
TEST(Models, DoublePendulumStartsWithTheTextbookAccelerations) {
  const double c = std::cos(pi / 4), g = 9.81;
  const double a = (-2 * g * std::sin(pi / 4) + c * g) / (2 - c * c), b = -g - c * a;
  const Vector zdot = reference::forward_dynamics(initial_terms("double_pendulum.toml"));
  EXPECT_NEAR(zdot[0], a, 1e-13);
  EXPECT_NEAR(zdot[1], b - a, 1e-13);
}

TEST(Models, CartPoleFollowsBartoSuttonAndAnderson) {
  const reference::Reference<double> reference(read_model(model_path("cart_pole.toml")));
  const double mc = 1, mp = 0.1, l = 0.5, g = 9.8, angle = 0.1, rate = 0.8, force = -10;
  const Vector y{{0.2, angle}}, z{{-0.5, rate}};
  const Vector zdot =
      reference::forward_dynamics(reference.evaluate({.t = 0, .y = y, .z = z}, Vector::Constant(1, force)));
  const double push = (force + mp * l * rate * rate * std::sin(angle)) / (mc + mp);
  const double angular = (g * std::sin(angle) - std::cos(angle) * push) /
                         (l * (4.0 / 3 - mp * std::cos(angle) * std::cos(angle) / (mc + mp)));
  EXPECT_NEAR(zdot[1], angular, 1e-13);
  EXPECT_NEAR(zdot[0], push - mp * l * angular * std::cos(angle) / (mc + mp), 1e-13);
}

// Straight and horizontal: rod k weighs on hinge i with the lever (k − i + ½), 0 ≤ i ≤ k < 4.
TEST(Models, ElasticArmStartsAtItsStaticDeflection) {
  const Terms terms = initial_terms("elastic_arm.toml");
  // The torques and deflections in the file carry the weight to rounding; the softest row of M is 0.01 kg m².
  EXPECT_LE(reference::forward_dynamics(terms).lpNorm<Eigen::Infinity>(), 1e-9);
}

TEST(Models, Chain4StartsStraightUnderItsWeight) {
  const Terms terms = initial_terms("chain4.toml");
  const double levers[] = {8.0, 4.5, 2.0, 0.5};
  ASSERT_EQ(terms.q_bar.size(), 4);
  for (Eigen::Index i = 0; i < 4; ++i) EXPECT_NEAR(terms.q_bar[i], 9.81 * levers[i], 1e-13);
  EXPECT_NEAR(terms.M(3, 3), 1.0 / 3, 1e-15);
  EXPECT_NEAR(terms.M(0, 0), 64.0 / 3, 1e-13);
  EXPECT_EQ(terms.kinetic_energy, 0);
}

}  // namespace
}  // namespace jourdain::tests
