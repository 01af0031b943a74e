// What rolls without slip on ground of a height, against planes, a bowl and a valley.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "agreement/shared_data.hpp"
#include "loops/closed_programs.hpp"
#include "loops/plan/plan.hpp"
#include "model/read/read.hpp"
#include "properties/consistent_state.hpp"
#include "properties/random.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::tests {
namespace {

using Long = long double;
using VectorL = reference::VectorX<Long>;
using Vector3L = reference::Vector3<Long>;

// Accelerations in double, M of condition 1e3.
constexpr double kRounding = 1e-12;

/// A body that flies, and what binds it.
std::string flying(const std::string& inertia, const std::string& position, const std::string& constraint) {
  return "[model]\nname = \"rolls\"\n[parameters]\nbowl = 0.6\n[[body]]\nname = \"body\"\nmass = 2\ninertia "
         "= " +
         inertia +
         "\n[[joint]]\nname = \"root\"\ntype = \"free\"\nparent = \"world\"\nchild = "
         "\"body\"\ninitial_position = " +
         position + "\n[[constraint]]\nname = \"ground\"\nframe = \"body\"\n" + constraint;
}

model::Mechanism read(const std::string& text) {
  support::Diagnostics diagnostics("rolls.toml", text);
  auto mechanism = model::read_mechanism(diagnostics, {});
  EXPECT_TRUE(mechanism) << diagnostics.format();
  return mechanism.value();
}

/// What the compiler says of a text that it refuses, or warns of.
std::string told(const std::string& text) {
  support::Diagnostics diagnostics("rolls.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics, {});
  if (mechanism) loops::plan_loops(*mechanism, diagnostics);
  return diagnostics.format();
}

struct Round {
  const char* keys;
  const char* inertia;
};
const Round kRounds[] = {
    {"type = \"rolling_wheel\"\nradius = 0.4\naxis = [0.1, 1, 0.2]\n", "[0.1, 0.2, 0.1]"},
    {"type = \"rolling_ball\"\nradius = 0.4\n", "[0.13, 0.14, 0.15]"},
    {"type = \"rolling_ellipsoid\"\nradii = [0.4, 0.3, 0.2]\n", "[0.1, 0.12, 0.15]"}};

/// A plane is ground of a height over another plane: the same accelerations, and forces along the ground.
TEST(RollingGround, SlopesAreInclinedPlanes) {
  double worst = 0;
  for (const Round& round : kRounds) {
    const model::Mechanism hill =
        read(flying(round.inertia, "[0, 0, 0.4]", std::string(round.keys) + "height = \"0.3*x - 0.2*y\"\n"));
    const model::Mechanism plane =
        read(flying(round.inertia, "[0, 0, 0.4]", std::string(round.keys) + "normal = [-0.3, 0.2, 1]\n"));
    const ClosedPrograms on_hill(hill), on_plane(plane);
    const auto states = consistent_states(plane, 17, 8);
    ASSERT_TRUE(states);
    for (const LoopState& state : *states) {
      const VectorL expected = on_plane.accelerations(state, VectorL(0));
      const double scale = 1 + double(expected.norm());
      worst = std::max(worst, double((on_hill.accelerations(state, VectorL(0)) - expected).norm()) / scale);
      const VectorL forces = on_hill.multipliers(state, VectorL(0)),
                    others = on_plane.multipliers(state, VectorL(0));
      worst = std::max(worst, double(std::fabs(forces[0] - others[0])) / scale);
      worst = std::max(worst, double(std::fabs(forces.tail(2).norm() - others.tail(2).norm())) / scale);
    }
  }
  fmt::print("slopes: accelerations and forces within {:.1e} of those on planes\n", worst);
  EXPECT_LE(worst, kRounding);
}

/// With e from the bowl's centre to the ball's, R = bowl - r between them and the spin w about e, which stays:
///   7/5 a = g along the bowl - 2/5 (r w/R) e x v, where a and v are of the centre.
TEST(RollingGround, BallInABowlFollowsItsEquations) {
  const model::Mechanism mechanism =
      read(flying("[0.008, 0.008, 0.008]", "[0, 0, 0.1]",
                  "type = \"rolling_ball\"\nradius = 0.1\nheight = \"bowl - sqrt(bowl^2 - x^2 - y^2)\"\n"));
  const ClosedPrograms programs(mechanism);
  const Long r = 0.1L, bowl = 0.6L, R = bowl - r;
  Random random(3);
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const Long angle = random.uniform(-1, 1), heading = random.uniform(-3, 3), spin = random.uniform(-20, 20);
    const Vector3L e(std::sin(angle) * std::cos(heading), std::sin(angle) * std::sin(heading),
                     -std::cos(angle));
    Vector3L v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    v -= v.dot(e) * e;
    LoopState state;
    state.y = VectorL::Zero(7);
    state.y.head(3) = Vector3L(0, 0, bowl) + R * e;
    state.y[3] = 1;
    state.z = VectorL(6);
    state.z << v, v.cross(e) / r + spin * e;
    const Vector3L g(0, 0, -9.81L), along = g - g.dot(e) * e;
    const Vector3L a = (along - 0.4L * r * spin / R * e.cross(v)) / 1.4L - v.squaredNorm() / R * e;
    // Of w = v x e/r + spin e.
    const Vector3L turn = a.cross(e) / r + spin / R * v;
    const VectorL zdot = programs.accelerations(state, VectorL(0));
    worst = std::max(worst, double((zdot.head(3) - a).norm() / a.norm()));
    worst = std::max(worst, double((zdot.tail(3) - turn).norm() / (1 + turn.norm())));
  }
  fmt::print("ball in a bowl: within {:.1e} of its equations\n", worst);
  EXPECT_LE(worst, kRounding);
}

/// An upright disc in a valley is a pendulum: 3/2 (R - r) a'' = -g sin a.
TEST(RollingGround, DiscInAValleyIsAPendulum) {
  const model::Mechanism mechanism =
      read(flying("[0.045, 0.09, 0.045]", "[0, 0, 0.3]",
                  "type = \"rolling_wheel\"\nradius = 0.3\nheight = \"2 - sqrt(4 - x^2)\"\n"));
  const ClosedPrograms programs(mechanism);
  const Long r = 0.3L, R = 2 - r;
  double worst = 0;
  for (const Long a : {-0.9L, -0.2L, 0.5L, 1.1L})
    for (const Long rate : {0.0L, 1.5L}) {
      LoopState state;
      state.y = VectorL::Zero(7);
      state.y[0] = R * std::sin(a);
      state.y[2] = 2 - R * std::cos(a);
      state.y[3] = 1;
      state.z = VectorL::Zero(6);
      state.z[0] = R * rate * std::cos(a);
      state.z[2] = R * rate * std::sin(a);
      state.z[4] = R * rate / r;
      const VectorL zdot = programs.accelerations(state, VectorL(0));
      const Long second = -9.81L * std::sin(a) / (1.5L * R);
      worst = std::max(worst, double(std::fabs(zdot[4] - R * second / r)));
      worst = std::max(worst,
                       double(std::fabs(zdot[0] - R * (second * std::cos(a) - rate * rate * std::sin(a)))));
    }
  fmt::print("disc in a valley: within {:.1e} of a pendulum\n", worst);
  EXPECT_LE(worst, kRounding);
}

/// Splines of tables are ground without kinks: on lines, and on a grid, within which it is.
TEST(RollingGround, TerrainsOfTablesAgreeWithTheDescriptorForm) {
  const std::string line =
      "[[table]]\nname = \"terrain\"\nx = [-4, -3, -2, -1, 0, 1, 2, 3, 4]\n"
      "values = [0, 0.1, 0, 0.2, 0, 0.1, 0.3, 0.1, 0]\ninterpolation = \"spline\"\nbeyond = \"extend\"\n";
  const std::string grid =
      "[[table]]\nname = \"terrain\"\nx = [-3, -1, 0, 1, 3]\ny = [-3, -1, 1, 3]\ninterpolation = \"spline\"\n"
      "values = [[0, 0.1, 0, 0.2], [0, 0.1, 0.3, 0.1], [0.1, 0.2, 0, 0], [0, -0.1, 0.1, 0], [0.2, 0, 0, "
      "0.1]]\n";
  double worst = 0;
  struct Case {
    const Round& round;
    std::string table, height;
  };
  for (const auto& [round, table, height] :
       {Case{kRounds[0], line, "terrain(x + 0.2*y)"}, Case{kRounds[1], grid, "terrain(x, y)"}}) {
    const model::Mechanism mechanism =
        read(table +
             flying(round.inertia, "[0.2, 0.1, 0.5]", round.keys + fmt::format("height = \"{}\"\n", height)));
    const ClosedPrograms programs(mechanism);
    const reference::DescriptorReference<Long> form(mechanism);
    const auto states = consistent_states(mechanism, 23, 4);
    ASSERT_TRUE(states);
    for (const LoopState& state : *states) {
      const VectorL expected = form.solve(state.t, state.y, state.z, VectorL(0)).zdot;
      worst = std::max(worst, double((programs.accelerations(state, VectorL(0)) - expected).norm()) /
                                  (1 + double(expected.norm())));
    }
  }
  fmt::print("terrains: accelerations within {:.1e} of the descriptor form\n", worst);
  EXPECT_LE(worst, kRounding);
}

/// Less than half of the operations that the same with every derivative through the search takes: 2954.
TEST(RollingGround, TakesFewOperations) {
  const std::string ball = "type = \"rolling_ball\"\nradius = 0.1\n";
  const auto count = [&](const std::string& more) {
    return ClosedPrograms(read(flying("[0.008, 0.008, 0.008]", "[0, 0, 0.1]", ball + more)))
        .operations("forward_dynamics");
  };
  const std::size_t plane = count(""), four = count("height = \"bowl - sqrt(bowl^2 - x^2 - y^2)\"\n"),
                    three = count("height = \"bowl - sqrt(bowl^2 - x^2 - y^2)\"\napproaches = 3\n");
  fmt::print("ball: {} operations on a plane, {} in a bowl, {} a Newton step\n", plane, four, four - three);
  EXPECT_LE(four, 900u);
  EXPECT_LE(four - three, 100u);
}

std::string on_ground(const std::string& height, const std::string& place = "[0.3, 0, 0.5]") {
  return flying("[0.2, 0.2, 0.2]", place,
                "type = \"rolling_ball\"\nradius = 0.5\nheight = \"" + height + "\"\n");
}

TEST(RollingGround, PointsThatAreNotFoundAreTold) {
  EXPECT_EQ(told(on_ground("0.1*sin(3*x)")).find("error"), std::string::npos);
  EXPECT_EQ(told(on_ground("0.1*sin(3*x)")).find("warning"), std::string::npos);
  // A search that ends, at a point that is farther than those around it: the ball would stand in the ground.
  for (const char* height : {"3*x^2", "3*x^2 + 3*y^2", "1.1*x^2 + 0.1*y"})
    EXPECT_NE(told(on_ground(height, "[0, 0, 0.5]"))
                  .find("the ground of constraint 'ground' is more curved at the start"),
              std::string::npos)
        << told(on_ground(height, "[0, 0, 0.5]"));
  EXPECT_NE(told(flying("[0.2, 0.2, 0.2]", "[0.3, 0, 0.5]",
                        "type = \"rolling_ball\"\nradius = 0.5\nheight = \"0.2*sin(3*x)\"\napproaches = 1\n"))
                .find("touches the ground is not found"),
            std::string::npos);
}

/// Ground that is too curved in one place: there State's opening tells that another point would be nearer.
TEST(RollingGround, StatesTellWhereTheGroundIsTooCurved) {
  const ClosedPrograms programs(read(on_ground("3*x^2/(1 + x^4)", "[-6, 0, 0.6]")));
  const double limit = programs.plan().greatest_opening();
  const std::vector<double> start = programs.plan().y, z(6);
  EXPECT_LE(programs.values("project", 0, start, z, {}).at("opening"), limit);
  EXPECT_GT(programs.values("project", 0, {0, 0, 0.5, 1, 0, 0, 0}, z, {}).at("opening"), limit);
}

}  // namespace
}  // namespace jourdain::tests
