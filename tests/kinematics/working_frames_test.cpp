// How links turn: single turns, reversed axes, runs of parallel axes, quaternions, against rotation matrices
// written down.
#include "kinematics/working_frames.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "dynamics/equations_at.hpp"
#include "dynamics/high_precision.hpp"
#include "dynamics/scene.hpp"

namespace jourdain::kinematics {
namespace {

constexpr double kRounding = 1e-15;  // sines and cosines, a few products

/// Frames of a scene, in numbers at positions y.
class FramesAt {
 public:
  FramesAt(const model::Mechanism& mechanism, std::vector<double> y)
      : layout_(model::lay_out_coordinates(mechanism)),
        leaves_(mechanism, layout_, statements_),
        tree_(build_link_tree(mechanism, leaves_.parameters, statements_, {})),
        states_(derive_link_states(mechanism, layout_, tree_, leaves_, statements_)),
        frames_(tree_, states_, statements_),
        y_(std::move(y)) {}

  const Link& link(std::size_t i) const { return tree_.links[i]; }
  double cosine(std::size_t i) const { return numbers({frames_.cosine(i), 0, 0})[0]; }
  double sine(std::size_t i) const { return numbers({frames_.sine(i), 0, 0})[0]; }
  std::array<double, 3> to_working(std::size_t i, const Vector3& v) {
    return numbers(frames_.to_working(i, v, "v"));
  }
  std::array<double, 3> to_link(std::size_t i, const Vector3& v) {
    return numbers(frames_.to_link(i, v, "v"));
  }
  std::array<double, 3> to_parent(std::size_t i, const Vector3& v) {
    return numbers(frames_.to_parent(i, v, "v"));
  }
  std::array<double, 3> from_parent(std::size_t i, const Vector3& v) {
    return numbers(frames_.from_parent(i, v, "v"));
  }
  std::array<double, 3> r_CW(std::size_t i) { return numbers(frames_.r_CW(i)); }

 private:
  std::array<double, 3> numbers(const Vector3& v) const {
    const dynamics::HighPrecision exact(
        statements_, [&](LeafKind kind, std::size_t i) { return kind == LeafKind::kPosition ? y_[i] : 0; });
    std::array<double, 3> values{};
    for (std::size_t k = 0; k < 3; ++k) values[k] = dynamics::to_double(exact.value(v[k]));
    return values;
  }

  Statements statements_;
  model::CoordinateLayout layout_;
  Leaves leaves_;
  LinkTree tree_;
  std::vector<LinkState> states_;
  WorkingFrames frames_;
  std::vector<double> y_;
};

void expect_near(const std::array<double, 3>& actual, const std::array<double, 3>& expected) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], kRounding) << "component " << i;
}

model::Mechanism turned(const char* axis) {
  return tests::one_body("mass = 1\ncenter_of_mass = [1, 0, 0]",
                         std::string("type = \"revolute\"\naxis = ") + axis);
}

TEST(WorkingFrames, ATurnAboutZTakesXTowardsY) {
  FramesAt frames(turned("[0, 0, 1]"), {0.7});
  EXPECT_EQ(frames.link(0).sign, 1);
  expect_near(frames.to_working(0, {1, 0, 5}), {std::cos(0.7), std::sin(0.7), 5});
  expect_near(frames.to_working(0, {0, 1, 0}), {-std::sin(0.7), std::cos(0.7), 0});
  expect_near(frames.to_link(0, {1, 0, 5}), {std::cos(0.7), -std::sin(0.7), 5});
}

// z of the link points along the parent's +z, so that its angle is −y.
TEST(WorkingFrames, ATurnAboutMinusZTakesXAwayFromY) {
  FramesAt frames(turned("[0, 0, -1]"), {0.7});
  EXPECT_EQ(frames.link(0).sign, -1);
  EXPECT_NEAR(frames.sine(0), -std::sin(0.7), kRounding);
  EXPECT_NEAR(frames.cosine(0), std::cos(0.7), kRounding);
  expect_near(frames.to_working(0, {1, 0, 5}), {std::cos(0.7), -std::sin(0.7), 5});
}

const char* const kRun = R"toml(
[[body]]
name = "d"
mass = 1
center_of_mass = [1, 0, 0]
[[joint]]
name = "k"
type = "revolute"
parent = "b"
child = "d"
position = [2, 0, 0]
axis = [0, 0, -1]
)toml";

TEST(WorkingFrames, ParallelAxesAddTheirAnglesWithTheirSigns) {
  FramesAt frames(tests::one_body("mass = 1\ncenter_of_mass = [1, 0, 0]", "type = \"revolute\"", kRun),
                  {0.7, 0.2});
  EXPECT_TRUE(frames.link(1).parallel);
  EXPECT_NEAR(frames.sine(1), std::sin(0.7 - 0.2), kRounding);
  EXPECT_NEAR(frames.cosine(1), std::cos(0.7 - 0.2), kRounding);
  expect_near(frames.r_CW(1), {2 * std::cos(0.7), 2 * std::sin(0.7), 0});
  expect_near(frames.to_parent(1, {1, 2, 3}), {1, 2, 3});
}

// Axis x: cyclic permutation of the frame, so that a vector along the axis stays and y goes towards z.
TEST(WorkingFrames, ATurnAboutXComesBackThroughItsOrientation) {
  FramesAt frames(turned("[1, 0, 0]"), {0.7});
  const auto axis = frames.to_parent(0, {0, 0, 1});
  expect_near(axis, {1, 0, 0});
  expect_near(frames.from_parent(0, {1, 0, 0}), {0, 0, 1});
}

TEST(WorkingFrames, ASlideMovesItsOriginAlongItsAxis) {
  FramesAt up(tests::one_body("mass = 1", "type = \"prismatic\"\naxis = [0, 0, 1]"), {0.7});
  expect_near(up.r_CW(0), {0, 0, 0.7});
  FramesAt down(tests::one_body("mass = 1", "type = \"prismatic\"\naxis = [0, 0, -1]"), {0.7});
  expect_near(down.r_CW(0), {0, 0, -0.7});
}

TEST(WorkingFrames, AScrewTurnsAndMovesByItsPitch) {
  FramesAt frames(tests::one_body("mass = 1\ncenter_of_mass = [1, 0, 0]", "type = \"screw\"\npitch = 0.25"),
                  {0.8});
  expect_near(frames.r_CW(0), {0, 0, 0.2});
  expect_near(frames.to_working(0, {1, 0, 0}), {std::cos(0.8), std::sin(0.8), 0});
}

// (½, ½, ½, ½) turns by a third of a turn about (1, 1, 1): x → y → z → x.
TEST(WorkingFrames, AQuaternionTakesTheChildsAxesToTheParents) {
  FramesAt frames(tests::one_body("mass = 1\ninertia = [1, 1, 1]", "type = \"spherical\""),
                  {0.5, 0.5, 0.5, 0.5});
  expect_near(frames.to_parent(0, {1, 0, 0}), {0, 1, 0});
  expect_near(frames.to_parent(0, {0, 1, 0}), {0, 0, 1});
  expect_near(frames.from_parent(0, {0, 0, 1}), {0, 1, 0});
}

// w = cos(a/2), z = sin(a/2): a turn by a about z.
TEST(WorkingFrames, AQuaternionHasItsScalarFirst) {
  FramesAt frames(tests::one_body("mass = 1\ninertia = [1, 1, 1]", "type = \"spherical\""),
                  {std::cos(0.35), 0, 0, std::sin(0.35)});
  expect_near(frames.to_parent(0, {1, 0, 0}), {std::cos(0.7), std::sin(0.7), 0});
}

}  // namespace
}  // namespace jourdain::kinematics
