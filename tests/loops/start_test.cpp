// Initial values that the description gives are kept where the loops allow it.
#include "loops/plan/start.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "loops/plan/plan.hpp"
#include "loops/plan/planned_start.hpp"
#include "model/read/read.hpp"

namespace jourdain::tests {
namespace {

using testing::HasSubstr;

/// Positions and velocities of crank, coupler and rocker that close the four-bar of models/four_bar.toml.
constexpr double kY[] = {1.0471975511965976, -0.6598498407116409, 1.598595310921279};
constexpr double kZ[] = {6.283185307179586, -7.455346572816508, 2.057346272142422};

/// That four-bar with these initial values, each one or several keys of its joint.
std::string four_bar(const std::string& crank, const std::string& coupler, const std::string& rocker,
                     const std::string& loops = "") {
  std::string text = "[model]\nname = \"four_bar\"\n";
  for (const char* body : {"crank_bar", "coupler_bar", "rocker_bar"})
    text += fmt::format("[[body]]\nname = \"{}\"\nmass = 1\ninertia = [0.01, 0.01, 0.01]\n", body);
  const auto joint = [&](const char* name, const char* parent, const char* position,
                         const std::string& keys) {
    text += fmt::format(
        "[[joint]]\nname = \"{0}\"\ntype = \"revolute\"\nparent = \"{1}\"\nchild = \"{0}_bar\"\nposition = "
        "{2}\n{3}\n",
        name, parent, position, keys);
  };
  joint("crank", "world", "[0, 0, 0]", crank);
  joint("coupler", "crank_bar", "[0.12, 0, 0]", coupler);
  joint("rocker", "world", "[0.4, 0, 0]", rocker);
  return text + R"([[frame]]
name = "coupler_end"
body = "coupler_bar"
position = [0.36, 0, 0]
[[frame]]
name = "rocker_end"
body = "rocker_bar"
position = [0.24, 0, 0]
[[loop]]
name = "pin"
type = "planar_pin"
from = "rocker_end"
to = "coupler_end"
)" + loops;
}

std::string keys(double position, double velocity) {
  return fmt::format("initial_position = {}\ninitial_velocity = {}", position, velocity);
}

struct Result {
  std::optional<loops::LoopPlan> plan;
  std::string messages;
};

Result plan(const std::string& text) {
  support::Diagnostics diagnostics("text.toml", text);
  const std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, {});
  Result result;
  if (mechanism) result.plan = loops::plan_loops(*mechanism, diagnostics);
  result.messages = diagnostics.format();
  return result;
}

TEST(LoopStart, ClosedValuesStayAsTheyAre) {
  const Result result = plan(four_bar(keys(kY[0], kZ[0]), keys(kY[1], kZ[1]), keys(kY[2], kZ[2])));
  ASSERT_TRUE(result.plan) << result.messages;
  EXPECT_TRUE(result.plan->moved.empty());
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(result.plan->y[k], kY[k], 1e-14);
    EXPECT_NEAR(result.plan->z[k], kZ[k], 1e-13);
  }
}

TEST(LoopStart, AVelocityThatIsGivenIsKeptAndOthersFollow) {
  for (const char* loops : {"", "[loops]\ntreatment = \"multipliers\"\n"}) {
    const Result result =
        plan(four_bar("initial_position = 1\ninitial_velocity = 8", "", "initial_position = 1.6", loops));
    ASSERT_TRUE(result.plan) << result.messages;
    EXPECT_EQ(result.plan->z[0], 8);
    EXPECT_NE(result.plan->z[2], 0);
  }
}

TEST(LoopStart, AnIndependentVelocityThatIsNotGivenYields) {
  const Result result =
      plan(four_bar("initial_position = 1", "", "initial_position = 1.6\ninitial_velocity = 2",
                    "[loops]\nindependent = [\"crank\"]\n"));
  ASSERT_TRUE(result.plan) << result.messages;
  EXPECT_EQ(result.plan->y[0], 1);
  EXPECT_EQ(result.plan->z[2], 2);
}

TEST(LoopStart, APositionThatIsGivenIsKeptWhereOthersCanCloseTheLoops) {
  const Result result = plan(four_bar("initial_position = 1.2", "", ""));
  ASSERT_TRUE(result.plan) << result.messages;
  EXPECT_EQ(result.plan->y[0], 1.2);
  EXPECT_NE(result.plan->y[1], 0);
}

/// All bars on one line, as they are without initial positions: no step leaves it.
TEST(LoopStart, DeadPointsAreLeftAfterAWarning) {
  const auto expect_closed = [](const Result& result) {
    ASSERT_TRUE(result.plan) << result.messages;
    EXPECT_THAT(result.messages, HasSubstr("warning: from the initial positions no step closes the loops"));
    const std::vector<double>& y = result.plan->y;
    EXPECT_NEAR(0.12 * std::cos(y[0]) + 0.36 * std::cos(y[0] + y[1]), 0.4 + 0.24 * std::cos(y[2]), 1e-14);
    EXPECT_NEAR(0.12 * std::sin(y[0]) + 0.36 * std::sin(y[0] + y[1]), 0.24 * std::sin(y[2]), 1e-14);
  };
  const Result free = plan(four_bar("", "", ""));
  expect_closed(free);
  EXPECT_EQ(free.plan->y, plan(four_bar("", "", "")).plan->y);
  expect_closed(plan(four_bar("", "", "", "[loops]\ntreatment = \"multipliers\"\n")));
  for (const char* loops : {"", "[loops]\nindependent = [\"crank\"]\n"}) {
    const Result at_zero = plan(four_bar(*loops ? "" : "initial_position = 0", "", "", loops));
    expect_closed(at_zero);
    EXPECT_EQ(at_zero.plan->y[0], 0);
  }
  const Result given = plan(four_bar("initial_position = 0", "initial_position = 0", "initial_position = 0"));
  EXPECT_FALSE(given.plan);
  EXPECT_THAT(given.messages, HasSubstr("cannot be closed from the initial values"));
}

TEST(LoopStart, DeadPointsAreLeftWithinRanges) {
  const Result above = plan(four_bar("", "", "range = [0, 3]")),
               below = plan(four_bar("", "", "range = [-3, 0]"));
  ASSERT_TRUE(above.plan && below.plan) << above.messages << below.messages;
  EXPECT_GT(above.plan->y[2], 0.1);
  EXPECT_LT(below.plan->y[2], -0.1);
}

TEST(LoopStart, GivenPositionsAndRangesAreBothMet) {
  const Result result = plan(four_bar("initial_position = 1.36", "", "range = [-0.05, 2.61]"));
  ASSERT_TRUE(result.plan) << result.messages;
  EXPECT_THAT(result.messages,
              HasSubstr("from the initial positions no step closes the loops within the ranges"));
  EXPECT_EQ(result.plan->y[0], 1.36);
  EXPECT_GT(result.plan->y[2], -0.05);
  EXPECT_LT(result.plan->y[2], 2.61);
  const Result out =
      plan(four_bar("initial_position = 1.36", "range = [-0.01, 0.01]", "range = [-0.01, 0.01]"));
  ASSERT_TRUE(out.plan) << out.messages;
  EXPECT_THAT(out.messages, HasSubstr("the loops close with 'coupler' at "));
}

/// A slider-crank of that size, m, whose slide starts far from where it closes; `crank` may give an initial position.
std::string slider_crank(double size, const std::string& crank) {
  std::string text = fmt::format("[model]\nname = \"slider_crank\"\ngravity = [0, {}, 0]\n", -9.81 * size);
  for (const char* body : {"crank_bar", "rod_bar", "slider"})
    text += fmt::format("[[body]]\nname = \"{0}\"\nmass = 1\ninertia = [{1}, {1}, {1}]\n", body,
                        0.1 * size * size);
  return text + fmt::format(R"([[joint]]
name = "crank"
type = "revolute"
parent = "world"
child = "crank_bar"
{2}
[[joint]]
name = "rod"
type = "revolute"
parent = "crank_bar"
child = "rod_bar"
position = [{0}, 0, 0]
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "slider"
axis = [1, 0, 0]
[[frame]]
name = "end"
body = "rod_bar"
position = [{1}, 0, 0]
[[loop]]
name = "pin"
type = "planar_pin"
from = "slider"
to = "end"
)",
                            0.4 * size, size, crank);
}

/// Micrometres or kilometres beside radians and the unit vectors of slides: no constraint is next to nothing for that,
/// and what is given stays.
TEST(LoopStart, MechanismsOfAnySizeCloseAlike) {
  for (const double size : {2.5e-5, 2.5e-4, 1e-3, 2e-3, 0.05, 1.0, 100.0, 1e3, 1e5}) {
    const Result kept = plan(slider_crank(size, "initial_position = 0.5"));
    ASSERT_TRUE(kept.plan) << size << ": " << kept.messages;
    EXPECT_EQ(kept.plan->freedom, 1u) << size << ": " << kept.messages;
    EXPECT_TRUE(kept.plan->redundant.empty()) << size;
    EXPECT_EQ(kept.plan->y[0], 0.5) << size;
    const double height = 0.4 * std::sin(0.5);
    EXPECT_NEAR(kept.plan->y[1], -0.5 - std::asin(height), 1e-12) << size;
    EXPECT_NEAR(kept.plan->y[2] / size, 0.4 * std::cos(0.5) + std::sqrt(1 - height * height), 1e-12) << size;
    const Result straight = plan(slider_crank(size, ""));
    ASSERT_TRUE(straight.plan) << size << ": " << straight.messages;
    EXPECT_NEAR(straight.plan->y[2] / size, 1.4, 1e-12) << size;
  }
}

/// A ball joint's tip that has to leave the direction in which it points.
TEST(LoopStart, DeadPointsOfBallJointsAreLeft) {
  const Result result = plan(
      "[model]\nname = \"m\"\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = "
      "\"j\"\ntype = "
      "\"spherical\"\nparent = \"world\"\nchild = \"b\"\n[[frame]]\nname = \"tip\"\nbody = \"b\"\nposition = "
      "[1, "
      "0, 0]\n"
      "[[frame]]\nname = \"wall\"\nbody = \"world\"\nposition = [0.5, 0, 0]\n[[loop]]\nname = \"l\"\ntype = "
      "\"point_in_plane\"\nfrom = \"wall\"\nto = \"tip\"\naxis = [1, 0, 0]\n");
  ASSERT_TRUE(result.plan) << result.messages;
  EXPECT_THAT(result.messages, HasSubstr("from the initial positions no step closes"));
  const std::vector<double>& q = result.plan->y;
  EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-14);
  EXPECT_NEAR(1 - 2 * (q[2] * q[2] + q[3] * q[3]), 0.5, 1e-13);
}

/// Which of two ways of closing was chance: other parameters do not draw again.
TEST(LoopStart, OtherParametersKeepTheWayOfClosing) {
  std::string text = four_bar("", "", "", "[loops]\ntreatment = \"multipliers\"\n");
  text.insert(text.find("[[body]]"), "[parameters]\nground = 0.4\n");
  text.replace(text.find("[0.4, 0, 0]"), 11, "[\"ground\", 0, 0]");
  support::Diagnostics diagnostics("text.toml", text);
  std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, {});
  ASSERT_TRUE(mechanism) << diagnostics.format();
  const std::optional<loops::LoopPlan> first = loops::plan_loops(*mechanism, diagnostics);
  ASSERT_TRUE(first) << diagnostics.format();
  const auto side = [](const auto& y) { return std::sin(double(y[2] - y[0] - y[1])); };
  for (const double ground : {0.2402, 0.241, 0.244, 0.25, 0.3, 0.5}) {
    mechanism->parameters[0].value = ground;
    support::Diagnostics ignored("--set", "");
    const std::optional<loops::Start> start = loops::planned_start(*mechanism, *first, ignored);
    ASSERT_TRUE(start) << ground << ignored.format();
    EXPECT_GT(side(start->configuration.y) * side(first->y), 0.0) << ground;
  }
}

TEST(LoopStart, PositionsWithFewDigitsAssembleNearby) {
  const Result all =
      plan(four_bar("initial_position = 1.0472", "initial_position = -0.6598", "initial_position = 1.5986"));
  ASSERT_TRUE(all.plan) << all.messages;
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(all.plan->y[k], kY[k], 1e-4);
  const Result two = plan(four_bar("initial_position = 1.0472", "initial_position = -0.6598", ""));
  ASSERT_TRUE(two.plan) << two.messages;
  EXPECT_NEAR(two.plan->y[0], 1.0472, 3e-3);
  EXPECT_NEAR(two.plan->y[2], kY[2], 1e-2);
}

TEST(LoopStart, GivenZerosYieldToOtherVelocities) {
  const Result result = plan(four_bar(keys(kY[0], kZ[0]), keys(kY[1], 0), keys(kY[2], 0)));
  ASSERT_TRUE(result.plan) << result.messages;
  EXPECT_EQ(result.plan->z[0], kZ[0]);
  EXPECT_NEAR(result.plan->z[2], kZ[2], 1e-12);
}

TEST(LoopStart, VelocitiesRoundedToSevenDigitsAgree) {
  const Result result = plan(four_bar(keys(kY[0], 6.283185), keys(kY[1], -7.455347), keys(kY[2], 2.057346)));
  ASSERT_TRUE(result.plan) << result.messages;
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(result.plan->z[k], kZ[k], 2e-6);
  EXPECT_FALSE(result.plan->moved.empty());
}

TEST(LoopStart, VelocitiesThatConflictAreAnError) {
  const Result result = plan(four_bar(keys(kY[0], kZ[0]), keys(kY[1], kZ[1]), keys(kY[2], 3)));
  EXPECT_FALSE(result.plan);
  EXPECT_THAT(result.messages, HasSubstr("text.toml:38:20: error: 'rocker' cannot start with 3"));
  EXPECT_THAT(result.messages, HasSubstr("the loops leave it 2.057346272"));
}

TEST(LoopStart, AMotionLeavesNothingToGive) {
  const Result result =
      plan(four_bar("motion = \"1 + 3*t\"", "", "initial_position = 1.6\ninitial_velocity = 3"));
  EXPECT_FALSE(result.plan);
  EXPECT_THAT(result.messages, HasSubstr("'rocker' cannot start with 3"));
  const Result held = plan(four_bar("motion = \"1\"", "", "initial_position = 1.6\ninitial_velocity = 3"));
  EXPECT_THAT(held.messages, HasSubstr("the loops leave it 0: write that"));
}

}  // namespace
}  // namespace jourdain::tests
