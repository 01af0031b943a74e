// Loops, which random scenes do not draw, are the same after writing and reading.
#include "properties/to_toml.hpp"

#include <gtest/gtest.h>

#include "model/read/read.hpp"

namespace jourdain::tests {
namespace {

model::Mechanism read(const std::string& text) {
  support::Diagnostics diagnostics("loops.toml", text);
  auto mechanism = model::read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "") << text;
  return mechanism.value_or(model::Mechanism());
}

const std::string kChain = R"([model]
name = "chain"
[parameters]
l = 2.0
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
range = [-1, 0.5]
[[joint]]
name = "guide"
type = "cylindrical"
parent = "crank"
child = "rod"
slide = { range = [0, 1], initial_position = 1 }
[[frame]]
name = "tip"
body = "rod"
position = [1, 0, 0]
)";

std::string loop(const std::string& type, const std::string& lines) {
  return "[[loop]]\nname = \"the_" + type + "\"\ntype = \"" + type + "\"\n" +
         (type == "residual" ? "" : "from = \"tip\"\nto = \"world\"\n") + lines;
}

TEST(ToToml, ConstraintsComeBackFromTheirDescription) {
  const std::string text = kChain + R"(
[[constraint]]
name = "bound"
velocity = "hinge.rate + sin(t)*tip.vx - tip.world_wy*rod.wx^0 - l"
[[constraint]]
name = "blade"
type = "knife_edge"
frame = "tip"
axis = [0, 1, 2]
plane = "crank"
[[constraint]]
name = "wheel"
type = "rolling_wheel"
frame = "tip"
radius = "l/2"
normal = [0, 1, 0]
[[constraint]]
name = "ball"
type = "rolling_ball"
frame = "rod"
radius = 0.5
[[constraint]]
name = "stone"
type = "rolling_ellipsoid"
frame = "rod"
radii = [1, "l", 3]
height = "0.1*sin(x/l) + 0.2*y*z/l"
approaches = 6
)";
  const model::Mechanism first = read(text), second = read(to_toml(first));
  ASSERT_EQ(first.loops.size(), 5u);
  EXPECT_EQ(to_toml(second), to_toml(first));
  for (std::size_t k = 0; k < first.loops.size(); ++k) EXPECT_EQ(second.loops[k].type, first.loops[k].type);
}

TEST(ToToml, LoopsComeBackFromTheirDescription) {
  std::string text = kChain;
  for (const char* type : {"revolute", "universal", "prismatic", "cylindrical"})
    text += loop(type, "axis = [0, 3, 0]\nto_axis = [1, 0.1, 0]\n");
  for (const char* type : {"planar_pin", "point_in_plane", "point_on_line"})
    text += loop(type, "axis = [0, 0.5, 1]\n");
  text += loop("ball", "") + loop("rod", "length = \"l + sin(t)\"\n") +
          loop("residual", "residual = \"tip.x - 2*guide_slide + rod.y*t\"\n");
  const model::Mechanism mechanism = read(text);
  ASSERT_EQ(mechanism.loops.size(), 10u);
  const model::Mechanism again = read(to_toml(mechanism));
  EXPECT_EQ(to_toml(again), to_toml(mechanism));
  for (std::size_t i = 0; i < 10; ++i) {
    const model::Loop &one = mechanism.loops[i], &other = again.loops.at(i);
    EXPECT_EQ(one.name, other.name);
    EXPECT_EQ(one.type, other.type);
    EXPECT_EQ(one.axis, other.axis);
    EXPECT_EQ(one.to_axis, other.to_axis);
    EXPECT_EQ(mechanism.frames[one.from.value].name, again.frames[other.from.value].name);
    EXPECT_EQ(mechanism.frames[one.to.value].name, again.frames[other.to.value].name);
  }
  EXPECT_EQ(again.joints[0].coordinates[0].range, mechanism.joints[0].coordinates[0].range);
  EXPECT_EQ(again.joints[1].coordinates[1].range, mechanism.joints[1].coordinates[1].range);
}

TEST(ToToml, OptionsOfLoopsComeBackFromTheirDescription) {
  for (const char* options :
       {"", "[loops]\n", "[loops]\ntreatment = \"multipliers\"\niterations = 3\nstabilisation = 0.1\n",
        "[loops]\ntreatment = \"partitioned\"\nindependent = [\"guide_slide\", \"hinge\"]\niterations = 20\n",
        "[loops]\ntreatment = \"explicit\"\nindependent = [\"hinge\"]\n"}) {
    const model::Mechanism mechanism = read(kChain + loop("ball", "") + options);
    const model::Mechanism again = read(to_toml(mechanism));
    EXPECT_EQ(to_toml(again), to_toml(mechanism));
    const model::LoopOptions &one = mechanism.loop_options, &other = again.loop_options;
    EXPECT_EQ(one.treatment, other.treatment);
    EXPECT_EQ(one.independent.size(), other.independent.size());
    EXPECT_EQ(one.iterations, other.iterations);
    EXPECT_EQ(one.stabilisation, other.stabilisation);
  }
}

}  // namespace
}  // namespace jourdain::tests
