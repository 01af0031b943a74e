// Contacts and tyres on ground of a height: where it rises evenly they are those on a tilted plane; where it is curved,
// those of a sphere; where it moves, they see what is left of their velocity.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "agreement/judge.hpp"
#include "ball_in_bowl/ball_in_bowl_kernels.hpp"
#include "compile/compile.hpp"
#include "model/read/read.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {
namespace {

using Vector3 = Eigen::Vector3d;

const std::string kBody = R"([model]
name = "thrown"
gravity = [0, 0, 0]
[parameters]
rise = 0.75
[[body]]
name = "body"
mass = 20
inertia = [0.6, 1, 0.6]
[[joint]]
name = "flight"
type = "free"
parent = "world"
child = "body"
)";

const std::string kPoint =
                      "[[contact]]\nframe = \"body\"\nstiffness = 1e5\nexponent = 1.5\ndamping = 0.3\n"
                      "friction = 0.4\nslip_speed = 0.1\n",
                  kBall = kPoint + "radius = 0.31\n",
                  kBristles =
                      "[[contact]]\nname = \"sole\"\nframe = \"body\"\nstiffness = 1e5\nradius = 0.31\n"
                      "friction = 0.4\nfriction_model = \"lugre\"\nbristle_stiffness = 1e4\n"
                      "bristle_damping = 5\n",
                  kTyre =
                      "[[tyre]]\nname = \"tyre\"\nframe = \"body\"\nradius = 0.31\nstiffness = 2e5\n"
                      "damping = 500\nfriction = 0.9\nrelaxation_length = 0.3\nlaw = \"brush\"\n"
                      "slip_stiffness = 14\n";

Derived scene(const std::string& element, const std::string& ground) {
  support::Diagnostics diagnostics("thrown.toml", kBody + element + ground);
  const auto mechanism = model::read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return derive(mechanism.value());
}

/// Of a body that is not turned.
Sample at(const Vector3& place, const Vector3& velocity, const Vector3& spin, std::size_t states = 0) {
  Sample sample;
  sample.parameters = {0.75};
  sample.y = {place.x(), place.y(), place.z(), 1, 0, 0, 0};
  sample.z = {velocity.x(), velocity.y(), velocity.z(), spin.x(), spin.y(), spin.z()};
  sample.z.resize(6 + states);
  sample.zdot = std::vector<double>(6 + states, 0);
  return sample;
}

std::vector<double> forces(const Derived& derived, const Sample& sample) {
  std::vector<double> q = interpreted<double>(derived.module, "q_bar", sample);
  for (double& force : q) force = -force;
  return q;
}

/// The same ground, as a height and as a tilted plane through one of its points; the plane's normal.
struct Slope {
  std::string height, plane;
  Vector3 normal, point;  ///< of the plane
};

const std::vector<Slope> kSlopes = {
    {"point = [0, 0, 0.1]\nheight = \"rise*x\"\n", "point = [0, 0, 0.1]\nnormal = [-0.75, 0, 1]\n",
     Vector3(-0.6, 0, 0.8), Vector3(0, 0, 0.1)},
    {"point = [3, 4, 0.1]\nheight = \"rise*x + 0.2*y + 0.02\"\n",
     "point = [0, 0, 0.12]\nnormal = [-0.75, -0.2, 1]\n", Vector3(-0.75, -0.2, 1).normalized(),
     Vector3(0, 0, 0.12)},
    {"point = [0, 0, 0.1]\nnormal = [0.6, 0, 0.8]\nheight = \"0.3*y\"\n",
     "point = [0, 0, 0.1]\nnormal = [0.6, -0.3, 0.8]\n", Vector3(0.6, -0.3, 0.8).normalized(),
     Vector3(0, 0, 0.1)},
    {"normal = [0, 1, 0]\nheight = \"0.1 - 0.5*x\"\n", "point = [0, 0.1, 0]\nnormal = [0.5, 1, 0]\n",
     Vector3(0.5, 1, 0).normalized(), Vector3(0, 0.1, 0)}};

TEST(Ground, ThatRisesEvenlyIsATiltedPlane) {
  Random random(5);
  int touching = 0, compared = 0;
  const auto number = [&random](double size) { return random.uniform(-size, size); };
  for (const Slope& slope : kSlopes)
    for (const auto& [element, radius, states] :
         {std::tuple(kPoint, 0.0, 0), std::tuple(kBall, 0.31, 0), std::tuple(kBristles, 0.31, 2),
          std::tuple(kTyre, 0.31, 2)}) {
      const Derived level = scene(element, slope.height), tilted = scene(element, slope.plane);
      for (int k = 0; k < 8; ++k) {
        const Vector3 side(number(1), number(1), number(1));
        const Vector3 place = slope.point + side - side.dot(slope.normal) * slope.normal +
                              (radius - 0.01 + number(0.02)) * slope.normal;
        const Vector3 velocity(number(2), number(2), number(2)), spin(number(3), number(3), number(3));
        Sample sample = at(place, velocity, spin, states);
        const bool tyre = element == kTyre;
        if (tyre) sample.z[6] = number(0.05);
        const std::vector<double> f = forces(level, sample), g = forces(tilted, sample);
        double size = 0;
        for (std::size_t i = 0; i < 6; ++i) size = std::max(size, std::fabs(g[i]));
        for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(f[i], g[i], 1e-11 * (1 + size)) << i << slope.height;
        // Directions of bristles are chosen in the plane: without a deflection their rates are one vector.
        if (states > 0 && !tyre) {
          EXPECT_NEAR(std::hypot(f[6], f[7]), std::hypot(g[6], g[7]), 1e-12 * (1 + std::hypot(g[6], g[7])));
        }
        for (std::size_t i = 6; tyre && i < 8; ++i) EXPECT_NEAR(f[i], g[i], 1e-12 * (1 + std::fabs(g[i])));
        touching += size > 0;
        ++compared;
      }
    }
  EXPECT_EQ(compared, 4 * 4 * 8);
  EXPECT_GE(touching, 60);
  EXPECT_LT(touching, compared);
}

/// A ball of radius r in a spherical bowl of radius 1, its centre over x: the normal leans by asin(s), at first with
/// s = x, then with x + r s, at last with x/(1 - r), where the bowl's centre, the ball's and the point that is touched
/// are in line.
TEST(Ground, ThatIsASphereIsTouchedAlongItsRadius) {
  const double r = 0.31, angle = 0.7, depth = 0.05;
  const Vector3 centre(std::sin(angle) * (1 - r + depth), 0, 1 - std::cos(angle) * (1 - r + depth));
  double leaning = centre.x();
  for (int approaches = 0; approaches <= 20; ++approaches) {
    const Derived bowl =
        scene("[[contact]]\nframe = \"body\"\nradius = 0.31\nstiffness = 1e5\n",
              fmt::format("height = \"1 - sqrt(1 - x^2 - y^2)\"\napproaches = {}\n", approaches));
    const std::vector<double> f = forces(bowl, at(centre, Vector3::Zero(), Vector3::Zero()));
    const Vector3 force(f[0], f[1], f[2]), normal(-leaning, 0, std::sqrt(1 - leaning * leaning));
    EXPECT_NEAR((force.normalized() - normal).norm(), 0, 1e-13) << approaches;
    // Behind the plane that touches the sphere with that normal.
    EXPECT_NEAR(force.norm() / 1e5, normal.dot(Vector3(0, 0, 1) - centre) - 1 + r, 1e-13) << approaches;
    leaning = centre.x() + r * leaning;
  }
  EXPECT_NEAR(leaning, centre.x() / (1 - r), 1e-10);
}

/// Slopes and their derivatives are computed once: Jacobians of a wheel on a road take a few times what forces take.
TEST(Ground, CostsLittleInJacobiansToo) {
  const auto operations = [](const std::string& ground, const std::string& function) {
    support::Diagnostics diagnostics("thrown.toml", kBody + kTyre + ground);
    CompileOptions options;
    options.name = "thrown";
    options.functions = {"forward_dynamics", "linearize"};
    const CompiledModel compiled = compile(model::read_mechanism(diagnostics).value(), options);
    EXPECT_TRUE(compiled.verdict.accepted());
    for (const ir::Program& program : compiled.module.functions)
      if (program.name == function) return ir::count_operations(program).arithmetic();
    return std::size_t(0);
  };
  const std::string road = "height = \"0.05*exp(-((x - 10)/0.4)^2)\"\n";
  const std::size_t forces = operations(road, "forward_dynamics"), slopes = operations(road, "linearize");
  fmt::print("on a road {} operations, with Jacobians {}; on a plane {} and {}\n", forces, slopes,
             operations("", "forward_dynamics"), operations("", "linearize"));
  EXPECT_LE(forces, 2 * operations("", "forward_dynamics"));
  EXPECT_GT(slopes, forces);
  EXPECT_LE(slopes, 8 * forces);
}

/// A hill that moves up, or to the side: what counts is the velocity against it.
TEST(Ground, ThatMovesIsAPlaneFromWhichVelocitiesAreCounted) {
  for (const std::string& element : {kPoint, kBall, kTyre}) {
    const std::size_t states = element == kTyre ? 2 : 0;
    const Derived moving = scene(element, "height = \"rise*x + 0.05*sin(10*t)\"\n"),
                  still =
                      scene(element, fmt::format("height = \"rise*x + {:.17g}\"\n", 0.05 * std::sin(3.0)));
    const double reach = element == kPoint ? 0 : 0.31;
    const Vector3 n(-0.6, 0, 0.8), place = Vector3(0, 0, 0.05 * std::sin(3.0)) + (reach - 0.005) * n;
    const Vector3 v(0.3, -0.2, 0.4), up(0, 0, 0.5 * std::cos(3.0)), spin(0.5, 1, -0.7);
    Sample sample = at(place, v, spin, states), relative = at(place, v - up, spin, states);
    sample.t = 0.3;
    if (states > 0) sample.z[6] = relative.z[6] = 0.02;
    const std::vector<double> f = forces(moving, sample), g = forces(still, relative);
    EXPECT_GT(std::fabs(g[2]), 10);
    for (std::size_t i = 0; i < f.size(); ++i)
      EXPECT_NEAR(f[i], g[i], 1e-11 * (1 + std::fabs(g[2]))) << i << element;
  }
}

/// models/ball_in_bowl.toml along a meridian: a pendulum of length (7/5) (R - r), whose period an
/// arithmetic-geometric mean has in closed form.
TEST(Ground, ABallRollsInABowlAsAPendulumOfSevenFifthsSwings) {
  ball_in_bowl::Parameters<> parameters;
  for (const auto& [radius, angle, bound] : {std::tuple(0.05, 0.3, 5e-5), std::tuple(0.1, 1.0, 5e-5)}) {
    parameters.radius = radius;
    const ball_in_bowl::Model<> model(parameters);
    auto state = initial_state(model);
    for (double& rate : state.z) rate = 0;
    const double sunk = parameters.mass * 9.81 / 1e5, way = parameters.bowl - radius + sunk;
    state.y[0] = way * std::sin(angle);
    state.y[2] = parameters.bowl - way * std::cos(angle);
    const double h = 1e-4;
    std::vector<double> crossings;
    for (int n = 0; crossings.size() < 5 && n < 100000; ++n) {
      const double before = state.y[0];
      rk4_step(model, state, {}, h);
      if ((before > 0) != (state.y[0] > 0)) crossings.push_back(h * (n + before / (before - state.y[0])));
    }
    ASSERT_EQ(crossings.size(), 5u);
    double a = 1, b = std::cos(angle / 2);
    for (int i = 0; i < 8; ++i) {
      const double mean = (a + b) / 2;
      b = std::sqrt(a * b);
      a = mean;
    }
    const double expected = 2 * std::acos(-1.0) * std::sqrt(1.4 * way / 9.81) / a;
    EXPECT_NEAR((crossings[4] - crossings[0]) / 2 / expected, 1, bound);
    EXPECT_EQ(state.y[1], 0);
  }
}

}  // namespace
}  // namespace jourdain::tests
