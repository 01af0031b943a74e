// Bushings: their law in formulas, that it has the potential it says, and what damping does to it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/equations_at.hpp"
#include "extremes/extreme_scenes.hpp"

namespace jourdain::tests {
namespace {

constexpr double kRounding = 1e-13;    // formulas in double, numbers up to 50
constexpr double kDifferences = 1e-7;  // of central differences with kStep, numbers up to 50
constexpr double kStep = 1e-5;
constexpr double kTurn[] = {0.5, 0.1, -0.7, 0.5};  // a unit quaternion

/// Two free bodies and a bushing between frames off their origins.
model::Mechanism two_free_bodies(const std::string& bushing) {
  const auto body = [](const char* name) {
    return fmt::format(R"([[body]]
name = "{0}"
mass = 2
center_of_mass = [0.1, 0, -0.2]
inertia = [1, 1.5, 2]
[[joint]]
name = "{0}_free"
type = "free"
parent = "world"
child = "{0}"
[[frame]]
name = "{0}_eye"
body = "{0}"
position = [0.3, -0.1, 0.2]
rpy = [0.4, -0.3, 1.1]
)",
                       name);
  };
  return read_scene("[model]\nname = \"two\"\ngravity = [0, 0, 0]\n" + body("a") + body("b") +
                    "[[bushing]]\n" + bushing);
}

constexpr const char* kElastic = R"(from = "a_eye"
to = "b_eye"
stiffness = [20, 7, 11]
torsional_stiffness = [3, 9, 4]
)";
constexpr const char* kDamping = "damping = [2, 0.5, 1]\ntorsional_damping = [0.3, 0.1, 0.7]\n";

/// Some position, with velocities `factor` times some others.
StateNumbers some_state(double factor) {
  StateNumbers state{{0.2, -0.3, 0.5, 1, 0, 0, 0, -0.4, 0.6, 0.1, kTurn[0], kTurn[1], kTurn[2], kTurn[3]},
                     {0.7, -1.1, 0.4, 0.9, 0.3, -0.8, -0.2, 0.6, 1.2, -0.5, 0.8, 0.1}};
  for (double& z : state.z) z *= factor;
  return state;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

TEST(Bushing, ATurnAboutAnAxisMeetsItsStiffnessTimesTheSine) {
  const double angle = 0.8, rate = 1.7;
  const model::Mechanism scene =
      one_body("mass = 1\ninertia = [1, 1, 1]", "type = \"revolute\"", R"([[bushing]]
from = "world"
to = "b"
torsional_stiffness = [5, 30, 8]
torsional_damping = [1, 2, 0.5]
)");
  const EquationsAt e = equations_at(scene, {{angle}, {rate}});
  EXPECT_NEAR(e.q_bar[0], 8 * std::sin(angle) + 0.5 * rate, kRounding);
  EXPECT_NEAR(e.potential_energy, 8 * (1 - std::cos(angle)), kRounding);
}

TEST(Bushing, PullsAlongTheAxesOfItsFirstFrame) {
  const model::Mechanism scene = one_body("mass = 1\ninertia = [1, 1, 1]", R"(type = "free"
[[frame]]
name = "seat"
body = "world"
rpy = [0, 0, "90*deg"]
[[bushing]]
from = "seat"
to = "b"
stiffness = [10, 20, 30]
damping = [1, 2, 3])");
  const EquationsAt e = equations_at(scene, {{0.1, 0.2, 0.3, 1, 0, 0, 0}, {0.4, 0.5, 0.6, 0, 0, 0}});
  EXPECT_NEAR(e.q_bar[0], 20 * 0.1 + 2 * 0.4, kRounding);  // y of the seat is −x
  EXPECT_NEAR(e.q_bar[1], 10 * 0.2 + 1 * 0.5, kRounding);
  EXPECT_NEAR(e.q_bar[2], 30 * 0.3 + 3 * 0.6 + 9.81, kRounding);
}

TEST(Bushing, ItsForcesAreTheSlopeOfItsPotential) {
  const model::Mechanism scene = two_free_bodies(kElastic);
  const StateNumbers state = some_state(1);
  const EquationsAt e = equations_at(scene, state);
  const auto energy_at = [&](double step) {
    StateNumbers moved = state;
    for (std::size_t i = 0; i < moved.y.size(); ++i) moved.y[i] += step * e.ydot[i];
    for (const std::size_t first : {3, 10}) {
      double length = 0;
      for (std::size_t i = first; i < first + 4; ++i) length += moved.y[i] * moved.y[i];
      for (std::size_t i = first; i < first + 4; ++i) moved.y[i] /= std::sqrt(length);
    }
    return equations_at(scene, moved).potential_energy;
  };
  EXPECT_NEAR((energy_at(kStep) - energy_at(-kStep)) / (2 * kStep), product(e.q_bar, state.z), kDifferences);
}

TEST(Bushing, WithoutDampingItsForcesFeelNoVelocity) {
  const model::Mechanism scene = two_free_bodies(kElastic);
  EXPECT_THAT(equations_at(scene, some_state(1)).q_bar,
              testing::Pointwise(testing::DoubleNear(kRounding), equations_at(scene, some_state(0)).q_bar));
}

TEST(Bushing, DampingTakesEnergyWhateverTheVelocity) {
  const model::Mechanism scene = two_free_bodies(std::string(kElastic) + kDamping);
  const std::vector<double> rest = equations_at(scene, some_state(0)).q_bar;
  for (std::size_t moving = 0; moving < 12; ++moving) {
    StateNumbers state = some_state(0);
    state.z[moving] = 1.3;
    state.z[(moving + 5) % 12] = -0.4;
    const std::vector<double> q_bar = equations_at(scene, state).q_bar;
    EXPECT_GT(product(q_bar, state.z) - product(rest, state.z), 0.01) << moving;
  }
}

TEST(Bushing, EqualStiffnessesAlongItsAxesLetTheFramesBeExchanged) {
  const char* numbers = "stiffness = [7, 7, 7]\ntorsional_stiffness = [3, 9, 4]\n";
  const StateNumbers state = some_state(1);
  const EquationsAt e =
      equations_at(two_free_bodies(std::string("from = \"a_eye\"\nto = \"b_eye\"\n") + numbers), state);
  const EquationsAt exchanged =
      equations_at(two_free_bodies(std::string("from = \"b_eye\"\nto = \"a_eye\"\n") + numbers), state);
  EXPECT_NEAR(e.potential_energy, exchanged.potential_energy, kRounding);
  EXPECT_THAT(e.q_bar, testing::Pointwise(testing::DoubleNear(kRounding), exchanged.q_bar));
}

// Forces on the origins (inertial axes) and moments about them (child axes), without inertia: −q̄ row by row.
TEST(Bushing, ActsAndReactsOnOneLineSoThatNoMomentIsLeft) {
  const model::Mechanism scene = two_free_bodies(std::string(kElastic) + kDamping);
  const StateNumbers state = some_state(1);
  const std::vector<double> q = equations_at(scene, state).q_bar;
  const double w = kTurn[0], x = kTurn[1], y = kTurn[2], z = kTurn[3];
  const double R[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                          {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                          {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(q[i] + q[6 + i], 0, kRounding);
    EXPECT_GT(std::fabs(q[i]), 1);
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double on_a = q[3 + i] + state.y[j] * q[k] - state.y[k] * q[j];
    const double turned = R[i][0] * q[9] + R[i][1] * q[10] + R[i][2] * q[11];
    const double on_b = turned + state.y[7 + j] * q[6 + k] - state.y[7 + k] * q[6 + j];
    EXPECT_NEAR(on_a + on_b, 0, kRounding);
  }
}

}  // namespace
}  // namespace jourdain::tests
