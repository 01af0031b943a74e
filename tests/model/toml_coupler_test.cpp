#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

constexpr const char* kDrive = R"([model]
name = "drive"
[parameters]
r = { value = 0.05, unit = "m" }
teeth = 20
[[body]]
name = "a"
mass = 1
inertia = [1, 1, 1]
[[body]]
name = "b"
mass = 1
inertia = [1, 1, 1]
[[body]]
name = "c"
mass = 1
inertia = [1, 1, 1]
[[joint]]
name = "wheel"
type = "revolute"
parent = "world"
child = "a"
initial_position = 2
initial_velocity = 4
[[joint]]
name = "rack"
type = "prismatic"
parent = "world"
child = "b"
[[joint]]
name = "cup"
type = "cylindrical"
parent = "world"
child = "c"
)";

struct Read {
  Mechanism mechanism;
  std::string diagnostics;
};

Read read(const std::string& more, const ReadOptions& options = {}) {
  support::Diagnostics diagnostics("drive.toml", kDrive + more);
  Mechanism mechanism = read_mechanism(diagnostics, options).value_or(Mechanism());
  return {std::move(mechanism), diagnostics.format()};
}

/// At wheel = y[0], rack = y[1], cup's angle and slide y[2] and y[3].
double residual(const Read& of, const std::array<double, 4>& y, std::size_t loop = 0) {
  const std::vector<double> parameters = default_values(of.mechanism);
  return of.mechanism.loops.at(loop).residual.evaluate<double>(
      parameters, [](double v) { return v; }, [&](const Variable& v) { return y.at(v.index + v.component); });
}

TEST(TomlCoupler, IsAResidualOfTheFollowerMinusWhatItFollows) {
  const Read of = read(
      "[[coupler]]\nname = \"mesh\"\ncoordinate = \"rack\"\nfollows = \"wheel\"\n"
      "ratio = \"-2*r\"\noffset = \"30 mm\"\n");
  EXPECT_EQ(of.diagnostics, "");
  ASSERT_EQ(of.mechanism.loops.size(), 1u);
  EXPECT_EQ(of.mechanism.loops[0].name, "mesh");
  EXPECT_EQ(of.mechanism.loops[0].type, LoopType::kResidual);
  EXPECT_EQ(of.mechanism.loops[0].follower->joint, JointIndex(1));
  EXPECT_NEAR(residual(of, {3, 7, 0, 0}), 7 + 2 * 0.05 * 3 - 0.03, 1e-15);
}

TEST(TomlCoupler, LetsFollowersStartWhereTheyFollowTo) {
  const Read of = read(
      "[[coupler]]\ncoordinate = \"cup_slide\"\nfollows = \"rack\"\nratio = 3\n"
      "[[coupler]]\ncoordinate = \"rack\"\nfollows = \"wheel\"\nratio = 0.5\noffset = 0.1\n");
  EXPECT_EQ(of.diagnostics, "");
  const Coordinate& rack = of.mechanism.joints[1].coordinates[0];
  const Coordinate& slide = of.mechanism.joints[2].coordinates[1];
  EXPECT_NEAR(rack.initial_position.constant(), 1.1, 1e-15);
  EXPECT_NEAR(rack.initial_velocity.constant(), 2, 1e-15);
  EXPECT_NEAR(slide.initial_position.constant(), 3.3, 1e-15);
  EXPECT_NEAR(slide.initial_velocity.constant(), 6, 1e-15);
}

TEST(TomlCoupler, TermsAddUpToTheOffset) {
  const Read of = read(
      "[[coupler]]\nname = \"d\"\nterms = { wheel = \"teeth\", cup_angle = -3, rack = "
      "\"1/r\" }\noffset = \"0.5 rad\"\n");
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_NEAR(residual(of, {1, 2, 3, 4}), 20 * 1 - 3 * 3 + 2 / 0.05 - 0.5, 1e-12);
  EXPECT_FALSE(of.mechanism.loops[0].follower);
}

TEST(TomlCoupler, TermsMayBeLengthsAsWell) {
  const Read of = read(
      "[[coupler]]\nname = \"d\"\nterms = { wheel = \"r\", cup_angle = \"30 mm\", rack = -1 }\n"
      "offset = \"2 mm\"\n");
  EXPECT_EQ(of.diagnostics, "");
  EXPECT_NEAR(residual(of, {1, 2, 3, 4}), 0.05 + 0.03 * 3 - 2 - 0.002, 1e-15);
}

constexpr const char* kChain =
    "[[coupler]]\nname = \"p\"\ncoordinate = \"rack\"\nfollows = \"wheel\"\n"
    "[[coupler]]\nname = \"q\"\ncoordinate = \"cup_angle\"\nfollows = \"rack\"\n";

TEST(TomlCoupler, OfALockedFollowerIsDropped) {
  const Read of = read(kChain, {.locked_joints = {"cup"}});
  ASSERT_EQ(of.mechanism.loops.size(), 1u);
  EXPECT_EQ(of.mechanism.loops[0].name, "p");
  EXPECT_NE(of.diagnostics.find("note: joint 'cup' is locked and does not follow 'rack'"), std::string::npos)
      << of.diagnostics;
}

/// The follower of one of two coordinates of a joint cannot be locked: its coupler holds it.
TEST(TomlCoupler, OfALockedLeaderLocksItsFollower) {
  const Read of = read(kChain, {.locked_joints = {"wheel"}});
  EXPECT_EQ(of.mechanism.joints[1].type, JointType::kFixed);
  EXPECT_EQ(of.mechanism.joints[2].type, JointType::kCylindrical);
  ASSERT_EQ(of.mechanism.loops.size(), 1u);
  EXPECT_EQ(residual(of, {1, 2, 3, 4}), 3);
}

TEST(TomlCoupler, IsGoneWithItsJoints) {
  const std::string held = "[[coupler]]\ncoordinate = \"rack\"\nfollows = \"wheel\"\nratio = \"0.5 m\"\n";
  const ReadOptions both = {.locked_joints = {"wheel", "rack"}};
  EXPECT_EQ(read(held, both).diagnostics, "");
  EXPECT_NE(read(held + "offset = \"0.1 m\"\n", both)
                .diagnostics.find("note: joint 'rack' is locked and does not follow 'wheel'"),
            std::string::npos);
  const Read of = read("[[coupler]]\nname = \"d\"\nterms = { wheel = 1, rack = 1 }\n",
                       {.locked_joints = {"wheel", "rack"}});
  EXPECT_TRUE(of.mechanism.loops.empty());
  EXPECT_EQ(of.diagnostics, "");
}

}  // namespace
}  // namespace jourdain::model
