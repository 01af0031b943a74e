// A point of mass m in the plane x-z, held to the origin by a rod of length l: g = (x² + z² − l²)/(2 l), G = (x, z)/l,
// γ = (ẋ² + ż²)/l. Small enough that every emitted function has a formula, at states where the loop is open as well.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "extremes/extreme_scenes.hpp"
#include "loops/loop_functions.hpp"

namespace jourdain::tests {
namespace {

constexpr double m = 2, l = 0.5, g = 9.81;
constexpr double kRounding = 1e-13;
/// Multipliers are regularised and corrected once: relative to their size.
constexpr double kRegularised = 1e-9;

model::Mechanism rod(const std::string& loops) {
  return read_scene(R"([model]
name = "point on a rod"
[[body]]
name = "carriage"
mass = 0
[[body]]
name = "point"
mass = 2
[[joint]]
name = "x"
type = "prismatic"
parent = "world"
child = "carriage"
axis = [1, 0, 0]
initial_position = 0.3
initial_velocity = 0.8
[[joint]]
name = "z"
type = "prismatic"
parent = "carriage"
child = "point"
axis = [0, 0, 1]
initial_position = -0.4
[[loop]]
name = "bar"
type = "rod"
from = "world"
to = "point"
length = 0.5
[loops]
)" + loops);
}

/// Of the rod with these lines in its [loops].
struct Functions : LoopFunctions {
  explicit Functions(const std::string& loops) : LoopFunctions(rod(loops)) {}
};

struct Point {
  double x, z, dx, dz;
  double opening() const { return (x * x + z * z - l * l) / (2 * l); }
  double rate() const { return (x * dx + z * dz) / l; }
  double gamma() const { return (dx * dx + dz * dz) / l; }
  /// λ of Newton's second law with g̈ + 2 s ġ + s² g = 0.
  double lambda(double s) const {
    const double needed = -g * z / l + gamma() + 2 * s * rate() + s * s * opening();
    return needed * m * l * l / (x * x + z * z);
  }
};
constexpr Point kOpen = {0.45, -0.5, 0.7, -1.1};  // 0.34 m open, opening further

class Stabilised : public testing::TestWithParam<double> {};

// At an open state that opens further both terms have their own size: 2 s ġ and s² g.
TEST_P(Stabilised, AccelerationsCloseWhatIsOpen) {
  const double s = GetParam();
  const Functions functions(fmt::format("treatment = \"multipliers\"\nstabilisation = {}", s));
  const Point& p = kOpen;
  const std::vector<double> a = functions("forward_dynamics", {p.x, p.z}, {p.dx, p.dz});
  const double lambda = p.lambda(s), size = 1 + std::fabs(lambda);
  EXPECT_NEAR(a[0], -p.x / l * lambda / m, kRegularised * size);
  EXPECT_NEAR(a[1], -p.z / l * lambda / m - g, kRegularised * size);
  EXPECT_NEAR((p.x * a[0] + p.z * a[1]) / l + p.gamma() + 2 * s * p.rate() + s * s * p.opening(), 0,
              kRegularised * size);
}

TEST_P(Stabilised, ConstraintForcesAreThoseOfTheAccelerations) {
  const Functions functions(fmt::format("treatment = \"multipliers\"\nstabilisation = {}", GetParam()));
  const double lambda = kOpen.lambda(GetParam());
  EXPECT_NEAR(functions("constraint_forces", {kOpen.x, kOpen.z}, {kOpen.dx, kOpen.dz})[0], lambda,
              kRegularised * (1 + std::fabs(lambda)));
}

// M ż − k̄ + q̄ + Gᵀ λ, at accelerations that have nothing to do with the state.
TEST_P(Stabilised, TheResidualHoldsTheConstraintForces) {
  const Functions functions(fmt::format("treatment = \"multipliers\"\nstabilisation = {}", GetParam()));
  const double lambda = kOpen.lambda(GetParam());
  const std::vector<double> r = functions("residual", {kOpen.x, kOpen.z}, {kOpen.dx, kOpen.dz}, {3, -4});
  EXPECT_NEAR(r[0], m * 3 + kOpen.x / l * lambda, kRegularised * (1 + std::fabs(lambda)));
  EXPECT_NEAR(r[1], m * -4 + m * g + kOpen.z / l * lambda, kRegularised * (1 + std::fabs(lambda)));
}

INSTANTIATE_TEST_SUITE_P(Rates, Stabilised, testing::Values(0.0, 1.0, 5.0, 20.0),
                         [](const auto& given) { return fmt::format("s{}", int(given.param)); });

TEST(PointOnARod, TheResidualOfTheConstraintIsItsDefinition) {
  for (const char* treatment :
       {"treatment = \"multipliers\"", "treatment = \"partitioned\"\nindependent = [\"x\"]"}) {
    const Functions functions(treatment);
    const bool reduced = std::string(treatment).find("part") != std::string::npos;
    const std::vector<double> z = reduced ? std::vector{kOpen.dx} : std::vector{kOpen.dx, kOpen.dz};
    const std::vector<double> r = functions("constraint_residual", {kOpen.x, kOpen.z}, z);
    EXPECT_NEAR(r[0], kOpen.opening(), kRounding);
    EXPECT_NEAR(r[1], reduced ? 0 : kOpen.rate(), kRounding);  // the other velocity follows from the first
  }
}

// Newton's method for z² = l² − x²: z ← z − (x² + z² − l²)/(2 z).
TEST(PointOnARod, ClosingIsNewtonsIteration) {
  for (const int iterations : {1, 2, 3}) {
    const Functions functions(
        fmt::format("treatment = \"partitioned\"\nindependent = [\"x\"]\niterations = {}", iterations));
    for (const double start : {-0.5, -0.41, -0.3}) {
      double z = start;
      for (int i = 0; i < iterations; ++i) z -= (0.3 * 0.3 + z * z - l * l) / (2 * z);
      EXPECT_NEAR(functions.closed("close_loops", {0.3, start})[1], z, kRounding) << iterations;
    }
  }
}

// What is left open is the square of what was open, over 2 |z|: four digits become eight.
TEST(PointOnARod, ClosingSquaresTheError) {
  const Functions functions("treatment = \"partitioned\"\nindependent = [\"x\"]\niterations = 1");
  for (const double error : {1e-1, -1e-1, 1e-2, -1e-3, 1e-4}) {
    const double left = functions.closed("close_loops", {0.3, -0.4 + error})[1] + 0.4;
    EXPECT_NEAR(left, error * error / (2 * (-0.4 + error)), kRounding) << error;
  }
}

// d = −M⁻¹ Gᵀ S⁻¹ g: along the rod. Then the velocity along the new direction goes, measured with the old one.
TEST(PointOnARod, ProjectionMovesAlongTheRod) {
  const Functions functions("treatment = \"multipliers\"");
  const Point& p = kOpen;
  const std::vector<double> moved = functions("project", {p.x, p.z}, {p.dx, p.dz});
  const double share = 1 - l * p.opening() / (p.x * p.x + p.z * p.z);
  EXPECT_NEAR(moved[0], p.x * share, kRegularised);
  EXPECT_NEAR(moved[1], p.z * share, kRegularised);
  const double along = (moved[0] * p.dx + moved[1] * p.dz) / (p.x * p.x + p.z * p.z);
  EXPECT_NEAR(moved[2], p.dx - p.x * along, kRegularised);
  EXPECT_NEAR(moved[3], p.dz - p.z * along, kRegularised);
}

TEST(PointOnARod, ProjectionSquaresTheError) {
  const Functions functions("treatment = \"multipliers\"");
  for (const double error : {1e-1, -1e-2, 1e-3}) {
    const double share = 1 + error;
    const std::vector<double> moved = functions("project", {0.3 * share, -0.4 * share}, {0, 0});
    EXPECT_NEAR(std::hypot(moved[0], moved[1]) / l - 1, error * error / (2 * share), kRegularised) << error;
  }
}

// With x independent: M = m (1 + x²/z²), k̄ = −m x (ẋ² + ż²)/z², q̄ = −m g x/z, ż = −x ẋ/z.
TEST(PointOnARod, ReducedEquationsAreThoseOfThePendulum) {
  const Functions functions("treatment = \"partitioned\"\nindependent = [\"x\"]");
  const double x = 0.3, z = -0.4, dx = 1.4, dz = -x * dx / z;
  const double M = m * (1 + x * x / (z * z)), k = -m * x * (dx * dx + dz * dz) / (z * z), q = -m * g * x / z;
  EXPECT_NEAR(functions("mass_matrix", {x, z}, {dx})[0], M, kRounding);
  EXPECT_NEAR(functions("k_bar", {x, z}, {dx})[0], k, kRounding);
  EXPECT_NEAR(functions("q_bar", {x, z}, {dx})[0], q, kRounding);
  EXPECT_NEAR(functions("forward_dynamics", {x, z}, {dx})[0], (k - q) / M, kRounding);
  EXPECT_NEAR(functions("residual", {x, z}, {dx}, {3})[0], M * 3 - k + q, kRounding);
  EXPECT_NEAR(functions("position_rate", {x, z}, {dx})[1], dz, kRounding);
  EXPECT_NEAR(functions("kinetic_energy", {x, z}, {dx})[0], m * (dx * dx + dz * dz) / 2, kRounding);
  EXPECT_NEAR(functions("potential_energy", {x, z}, {dx})[0], m * g * z, kRounding);
}

// λ from Newton's second law across the rod: m (ẍ, z̈) = (0, −m g) − (x, z)/l λ.
TEST(PointOnARod, ReducedEquationsHaveTheSameConstraintForce) {
  const Functions functions("treatment = \"partitioned\"\nindependent = [\"x\"]");
  const Point p = {0.3, -0.4, 1.4, 0.3 * 1.4 / 0.4};
  EXPECT_NEAR(functions("constraint_forces", {p.x, p.z}, {p.dx})[0], p.lambda(0), kRounding * 50);
}

// The file's values close the loop: they are what a model starts from, ż that goes with ẋ included.
TEST(PointOnARod, StartsWhereTheFileSays) {
  const std::vector<double> reduced =
      Functions("treatment = \"partitioned\"\nindependent = [\"x\"]")("initial_state", {}, {});
  ASSERT_EQ(reduced.size(), 3u);
  EXPECT_NEAR(reduced[0], 0.3, kRounding);
  EXPECT_NEAR(reduced[1], -0.4, kRounding);
  EXPECT_NEAR(reduced[2], 0.8, kRounding);
  const std::vector<double> all = Functions("treatment = \"multipliers\"")("initial_state", {}, {});
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(all[2], 0.8, kRounding);
  EXPECT_NEAR(all[3], 0.6, kRounding);
}

}  // namespace
}  // namespace jourdain::tests
